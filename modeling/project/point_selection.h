#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/solid/solid.h"

// Selections of the control points for a command: by number, by place in the nets, or by position.
namespace palpa::modeling {

struct PointSelection;

/// Control points by number.
struct PointIndices {
  std::vector<int> indices;
  bool operator==(const PointIndices&) const = default;
};

/// All points of the nets of the named patches, including the borders.
struct PatchPoints {
  std::vector<std::string> patches;
  bool operator==(const PatchPoints&) const = default;
};

/// The row of points along one side of a patch: an edge of the solid.
struct SidePoints {
  std::string patch;
  Side side = Side::kVMin;
  bool operator==(const SidePoints&) const = default;
};

/// Points of one net by row i along u and row j along v. Without a number all rows are selected;
/// negative numbers count from the end (-1 is the last row).
struct NetPoints {
  std::string patch;
  std::array<std::optional<int>, 2> at;
  bool operator==(const NetPoints&) const = default;
};

/// Points x with above < normal · x < below; one of the limits may be absent. For a unit normal the
/// limits are distances from the origin in mm.
struct SlabPoints {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::optional<double> above;
  std::optional<double> below;
  bool operator==(const SlabPoints&) const = default;
};

/// Points in an axis-parallel box, including its faces; mm.
struct BoxPoints {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  bool operator==(const BoxPoints&) const = default;
};

/// Points in a ball, including its surface; mm.
struct BallPoints {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
  bool operator==(const BallPoints&) const = default;
};

/// Points in all of the selections.
struct AllOf {
  std::vector<PointSelection> selections;
  bool operator==(const AllOf&) const;
};

/// Points in none of the selections.
struct NoneOf {
  std::vector<PointSelection> selections;
  bool operator==(const NoneOf&) const;
};

/// The union of its parts.
struct PointSelection {
  using Part = std::variant<PointIndices, PatchPoints, SidePoints, NetPoints, SlabPoints, BoxPoints,
                            BallPoints, AllOf, NoneOf>;
  std::vector<Part> parts;

  bool operator==(const PointSelection&) const = default;

  static PointSelection of(std::vector<int> indices) {
    return {{PointIndices{std::move(indices)}}};
  }
};

inline bool AllOf::operator==(const AllOf& other) const {
  return selections == other.selections;
}
inline bool NoneOf::operator==(const NoneOf& other) const {
  return selections == other.selections;
}

/// The selected control points, each once: in the order of the list if the selection consists of
/// numbers only, otherwise ascending.
/// Throws ModelingError that begins with `path` if an index or a row is out of range, a patch does
/// not exist, a limit is not finite, or no point is selected.
std::vector<int> selectPoints(const PointSelection& selection, const Solid& solid,
                              const std::string& path = "points");

}  // namespace palpa::modeling
