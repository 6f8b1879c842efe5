#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "modeling/body/body.h"

namespace palpa::modeling {

/// Unit of length that a file may have.
struct LengthUnit {
  const char* name;  ///< as in options and dialogs
  double mm;
};

inline constexpr std::array<LengthUnit, 8> kLengthUnits{{{"mm", 1.0},
                                                         {"cm", 10.0},
                                                         {"m", 1000.0},
                                                         {"km", 1e6},
                                                         {"um", 1e-3},
                                                         {"mil", 0.0254},
                                                         {"in", 25.4},
                                                         {"ft", 304.8}}};

/// "mm, cm, m, … or ft".
std::string lengthUnitsText();

/// "in" for 25.4; another length in mm as "2.5 mm".
std::string lengthUnitText(double mm);

/// Axis of a file that points up. It becomes +z of the body.
enum class UpAxis { kX, kMinusX, kY, kMinusY, kZ, kMinusZ };

/// In the order of UpAxis, as in options.
inline constexpr std::array<const char*, 6> kUpAxisNames{"x", "-x", "y", "-y", "z", "-z"};

/// Rotation by a multiple of 90° about x or y that turns the axis to +z. Its entries are 0 and ±1.
Eigen::Matrix3d rotationOf(UpAxis up);

/// How the lengths and axes of a file become lengths and axes of the body.
struct ImportPlacement {
  /// mm per unit of length of the file, instead of the unit that a CAD file states; 0: that unit,
  /// or mm for a mesh file, which states none.
  double unit = 0.0;
  double scale = 1.0;  ///< in addition to the unit
  UpAxis up = UpAxis::kZ;

  /// Factor for lengths in mm that were read with `fileUnit` (mm per unit; 0: several units).
  /// Throws ModelingError if a unit is given, but the file has several.
  double factor(double fileUnit) const;

  /// Throws ModelingError that names the field if a number is not finite or out of range.
  void validate() const;
};

/// The body with its lengths multiplied by `factor`, then rotated. Names, patches and triangles do
/// not change. Throws ModelingError if the result is too large.
Body placed(const Body& body, double factor, UpAxis up);

/// A sentence for the user if the largest dimension in mm suggests a wrong unit: below 0.1 mm or
/// above 5 m. Empty otherwise.
std::string sizeWarning(const Eigen::Vector3d& size);

/// "40 × 30 × 20 mm".
std::string sizeText(const Eigen::Vector3d& size);

}  // namespace palpa::modeling
