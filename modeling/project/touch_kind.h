#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace palpa::modeling {

/// How a touch acts on the body. kPin stays the last, so that a kind without a row in kTouchKinds
/// does not compile.
enum class TouchKind {
  kGrab,   ///< moves the place from its position on the unloaded shape, all three components
  kForce,  ///< pulls or presses with a given force
  kPush,   ///< a fingertip's pressure mask
  kBall,   ///< a rigid ball; the contact grows with depth
  kPin,    ///< grabs the place where supports and loads alone leave it, or moves it from there
};

/// What programs and files say of a kind of touch, and which parameters it has.
struct TouchKindInfo {
  TouchKind kind;
  const char* name;        ///< in files, options and reports
  const char* formerName;  ///< in files of older versions; null: the same
  const char* label;       ///< in the window, to be translated
  const char* vectorKey;   ///< in files: a displacement (mm) or a force (N)
  bool needsVector;        ///< otherwise the vector is zero when absent
  /// Presses but does not pull, and slides with friction; displacements count from first contact.
  bool presses;
};

inline constexpr std::array kTouchKinds{
    TouchKindInfo{TouchKind::kGrab, "grab", nullptr, "Grab", "displace_mm", true, false},
    TouchKindInfo{TouchKind::kForce, "force", nullptr, "Force", "force_N", true, false},
    TouchKindInfo{TouchKind::kPush, "push", nullptr, "Push", "displace_mm", true, true},
    TouchKindInfo{TouchKind::kBall, "ball", "probe", "Ball", "displace_mm", true, true},
    TouchKindInfo{TouchKind::kPin, "pin", nullptr, "Pin", "displace_mm", false, false},
};

constexpr const TouchKindInfo& infoOf(TouchKind kind) {
  return kTouchKinds[static_cast<std::size_t>(kind)];
}

static_assert(kTouchKinds.size() == 1 + static_cast<std::size_t>(TouchKind::kPin));
static_assert([] {
  for (const TouchKindInfo& info : kTouchKinds)
    if (infoOf(info.kind).name != info.name) return false;
  return true;
}());

/// The kind with this name; none if there is no such kind.
constexpr std::optional<TouchKind> touchKindNamed(std::string_view name) {
  for (const TouchKindInfo& info : kTouchKinds)
    if (name == info.name) return info.kind;
  return std::nullopt;
}

/// The present name of a kind for its former name; all other text as it is.
constexpr std::string_view presentKindName(std::string_view name) {
  for (const TouchKindInfo& info : kTouchKinds)
    if (info.formerName && name == info.formerName) return info.name;
  return name;
}

}  // namespace palpa::modeling
