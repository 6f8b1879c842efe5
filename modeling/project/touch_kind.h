#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace palpa::modeling {

/// How a touch acts on the body. kPin stays the last, so that a kind without a row in kTouchKinds
/// does not compile.
enum class TouchKind {
  kGrab,   ///< prescribes all three components of the displacement from the unloaded shape
  kForce,  ///< pulls or presses with a given force
  kPush,   ///< presses with the pressure mask of a fingertip
  kBall,   ///< presses with a rigid ball; the contact area grows with depth
  kPin,    ///< fixes the place, or moves it, from its position under supports and loads alone
};

/// Names and parameters of a kind of touch.
struct TouchKindInfo {
  TouchKind kind;
  const char* name;        ///< in files, options and reports
  const char* formerName;  ///< in files of older versions; null: the same
  const char* label;       ///< in the window, to be translated
  bool isForce;            ///< the vector is a force (N), otherwise a displacement (mm)
  bool needsVector;        ///< otherwise the vector is zero when absent
  /// Presses but does not pull, and slides with friction; displacements start at first contact.
  bool presses;
  bool isBall;  ///< `radius` is of a rigid ball, otherwise of the pressure mask

  constexpr const char* vectorKey() const { return isForce ? "force_N" : "displace_mm"; }
};

inline constexpr double kMaxFriction = 10.0;  // Coulomb's coefficient

inline constexpr std::array kTouchKinds{
    TouchKindInfo{TouchKind::kGrab, "grab", nullptr, "Grab", false, true, false, false},
    TouchKindInfo{TouchKind::kForce, "force", nullptr, "Force", true, true, false, false},
    TouchKindInfo{TouchKind::kPush, "push", nullptr, "Push", false, true, true, false},
    TouchKindInfo{TouchKind::kBall, "ball", "probe", "Ball", false, true, true, true},
    TouchKindInfo{TouchKind::kPin, "pin", nullptr, "Pin", false, false, false, false},
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
