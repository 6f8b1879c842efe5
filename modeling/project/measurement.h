#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// What a measurement measures. kRadius stays the last, so that a kind without a row in
/// kMeasurementKinds does not compile.
enum class MeasurementKind {
  kDistance,  ///< shortest distance between two points, edges or faces
  kLength,    ///< arc length of an edge
  kAngle,  ///< between two faces, two edges, an edge and a face, or at the second of three points
  kThickness,  ///< from a surface point along the inner normal to the opposite surface
  kRadius,     ///< of curvature, at a surface point or at a point of an edge
};

/// Names of a kind of measurement.
struct MeasurementKindInfo {
  MeasurementKind kind;
  const char* name;   ///< in files, options and reports
  const char* label;  ///< in the window, to be translated
  std::size_t leastPlaces, mostPlaces;
};

inline constexpr std::array kMeasurementKinds{
    MeasurementKindInfo{MeasurementKind::kDistance, "distance", "Distance", 2, 2},
    MeasurementKindInfo{MeasurementKind::kLength, "length", "Length", 1, 1},
    MeasurementKindInfo{MeasurementKind::kAngle, "angle", "Angle", 2, 3},
    MeasurementKindInfo{MeasurementKind::kThickness, "thickness", "Wall thickness", 1, 1},
    MeasurementKindInfo{MeasurementKind::kRadius, "radius", "Radius", 1, 1},
};

constexpr const MeasurementKindInfo& infoOf(MeasurementKind kind) {
  return kMeasurementKinds[static_cast<std::size_t>(kind)];
}

static_assert(kMeasurementKinds.size() == 1 + static_cast<std::size_t>(MeasurementKind::kRadius));

/// The kind with this name; none if there is no such kind.
constexpr std::optional<MeasurementKind> measurementKindNamed(std::string_view name) {
  for (const MeasurementKindInfo& info : kMeasurementKinds)
    if (name == info.name) return info.kind;
  return std::nullopt;
}

/// Place on the surface by names and parameters instead of coordinates, so that a measurement
/// follows edits of the body.
struct MeasuredPlace {
  /// The point itself, or the whole edge or face that it lies on.
  enum class What { kPoint, kEdge, kFace };
  What what = What::kPoint;
  std::string patch;  ///< or face of a mesh body
  /// Of a solid: fractions (0 … 1) of the ranges of u and v. Of a mesh body: position in mm.
  std::variant<Eigen::Vector2d, Eigen::Vector3d> at = Eigen::Vector2d(0.5, 0.5);
  std::optional<Side> side{};  ///< of the patch, for an edge of a solid
  std::string other{};         ///< face on the other side of an edge of a mesh body

  bool operator==(const MeasuredPlace&) const = default;
};

/// Names of MeasuredPlace::What in files and options, in its order.
inline constexpr std::array<const char*, 3> kMeasuredWhatNames{"point", "edge", "face"};

/// A named measurement of the body. Places that are gone are no error of the project: they may
/// come back by an undo.
struct Measurement {
  std::string name;
  MeasurementKind kind = MeasurementKind::kDistance;
  std::vector<MeasuredPlace> places;

  bool operator==(const Measurement&) const = default;
};

/// Checks kind, number and kinds of places, and ranges of their numbers. Throws ModelingError that
/// begins with `path` (`measurements[0]`).
void checkMeasurement(const Measurement& measurement, const std::string& path);

}  // namespace palpa::modeling
