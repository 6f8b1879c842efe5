#pragma once

#include <optional>
#include <string_view>

#include "bem/contact/contact_simulation.h"
#include "modeling/project/touch_kind.h"

// Kinds of touch (what projects store) and kinds of contact (what the solvers compute).
namespace palpa::app {

/// The contact that a touch makes. A pin is a grab whose value counts from the deformed surface.
constexpr bem::ContactTool::Kind contactKindOf(modeling::TouchKind kind) {
  using Kind = bem::ContactTool::Kind;
  switch (kind) {
    case modeling::TouchKind::kGrab:
    case modeling::TouchKind::kPin:
      return Kind::kGrab;
    case modeling::TouchKind::kForce:
      return Kind::kForce;
    case modeling::TouchKind::kPush:
      return Kind::kPush;
    case modeling::TouchKind::kBall:
      return Kind::kBall;
  }
  return Kind::kGrab;
}

/// The touch as which a contact is saved and shown.
constexpr modeling::TouchKind touchKindOf(bem::ContactTool::Kind kind) {
  using Kind = bem::ContactTool::Kind;
  switch (kind) {
    case Kind::kGrab:
      return modeling::TouchKind::kGrab;
    case Kind::kForce:
      return modeling::TouchKind::kForce;
    case Kind::kPush:
      return modeling::TouchKind::kPush;
    case Kind::kBall:
      return modeling::TouchKind::kBall;
  }
  return modeling::TouchKind::kGrab;
}

constexpr const modeling::TouchKindInfo& infoOf(bem::ContactTool::Kind kind) {
  return modeling::infoOf(touchKindOf(kind));
}

/// The contact with this name in recordings; none if there is no such kind.
constexpr std::optional<bem::ContactTool::Kind> contactKindNamed(std::string_view name) {
  const auto kind = modeling::touchKindNamed(name);
  if (!kind || *kind == modeling::TouchKind::kPin) return std::nullopt;
  return contactKindOf(*kind);
}

static_assert([] {
  for (const modeling::TouchKindInfo& info : modeling::kTouchKinds) {
    const bem::ContactTool tool{contactKindOf(info.kind)};
    if (tool.presses() != info.presses) return false;
    if (touchKindOf(tool.kind) != info.kind && info.kind != modeling::TouchKind::kPin) return false;
  }
  return true;
}());

}  // namespace palpa::app
