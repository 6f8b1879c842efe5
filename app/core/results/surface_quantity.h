#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace palpa::app {

/// What the surface can be coloured by. kStiffnessGradient stays the last, so that a quantity
/// without a row in kSurfaceQuantities does not compile.
enum class SurfaceQuantity {
  kNone,
  kDisplacement,    ///< |u|
  kNormalTraction,  ///< positive outwards
  kVonMises,
  kStiffness,          ///< under a fingertip; of the body alone (bem::StiffnessMap)
  kStiffnessGradient,  ///< of one touch, by material added at the surface (SurfaceGradient)
};

/// What programs say of a quantity, and how it is coloured.
struct SurfaceQuantityInfo {
  SurfaceQuantity quantity;
  const char* name;   ///< in options
  const char* label;  ///< beside the colours, to be translated
  const char* unit;   ///< of its numbers
  bool isSigned;      ///< the colours are symmetric about zero
  bool startsAtZero;  ///< so do the colours
  bool isLogarithmic;
};

inline constexpr std::array kSurfaceQuantities{
    SurfaceQuantityInfo{SurfaceQuantity::kNone, "none", "", "", false, false, false},
    SurfaceQuantityInfo{SurfaceQuantity::kDisplacement, "displacement", "Displacement |u|", "mm",
                        false, true, false},
    SurfaceQuantityInfo{SurfaceQuantity::kNormalTraction, "normal-traction", "Normal traction",
                        "MPa", true, false, false},
    SurfaceQuantityInfo{SurfaceQuantity::kVonMises, "von-mises", "von Mises stress", "MPa", false,
                        false, false},
    SurfaceQuantityInfo{SurfaceQuantity::kStiffness, "stiffness", "Stiffness", "N/mm", false, false,
                        true},
    SurfaceQuantityInfo{SurfaceQuantity::kStiffnessGradient, "stiffness-gradient",
                        "Stiffness gradient", "N/mm per cm³", true, false, false},
};

constexpr const SurfaceQuantityInfo& infoOf(SurfaceQuantity quantity) {
  return kSurfaceQuantities[static_cast<std::size_t>(quantity)];
}

static_assert(kSurfaceQuantities.size() ==
              1 + static_cast<std::size_t>(SurfaceQuantity::kStiffnessGradient));
static_assert([] {
  for (const SurfaceQuantityInfo& info : kSurfaceQuantities)
    if (infoOf(info.quantity).name != info.name) return false;
  return true;
}());

/// True if the quantity is a property of a field, with values at each of its states; the others are
/// computed otherwise.
constexpr bool isOfField(SurfaceQuantity quantity) {
  return quantity != SurfaceQuantity::kNone && quantity != SurfaceQuantity::kStiffness &&
         quantity != SurfaceQuantity::kStiffnessGradient;
}

/// The quantity with this name; none if there is no such quantity.
constexpr std::optional<SurfaceQuantity> surfaceQuantityNamed(std::string_view name) {
  for (const SurfaceQuantityInfo& info : kSurfaceQuantities)
    if (name == info.name) return info.quantity;
  return std::nullopt;
}

}  // namespace palpa::app
