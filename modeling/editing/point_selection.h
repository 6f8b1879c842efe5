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
};

/// All points of the nets of the named patches, including the borders.
struct PatchPoints {
  std::vector<std::string> patches;
};

/// The row of points along one side of a patch: an edge of the solid.
struct SidePoints {
  std::string patch;
  Side side = Side::kVMin;
};

/// Points of one net by row i along u and row j along v. Without a number all rows are selected;
/// negative numbers count from the end (-1 is the last row).
struct NetPoints {
  std::string patch;
  std::array<std::optional<int>, 2> at;
};

/// Points x with above < normal · x < below; one of the limits may be absent. For a unit normal the
/// limits are distances from the origin in mm.
struct SlabPoints {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::optional<double> above;
  std::optional<double> below;
};

/// Points in an axis-parallel box, including its faces; mm.
struct BoxPoints {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// Points in a ball, including its surface; mm.
struct BallPoints {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
};

/// Points in all of the selections.
struct AllOf {
  std::vector<PointSelection> selections;
};

/// Points in none of the selections.
struct NoneOf {
  std::vector<PointSelection> selections;
};

/// The union of its parts.
struct PointSelection {
  using Part = std::variant<PointIndices, PatchPoints, SidePoints, NetPoints, SlabPoints, BoxPoints,
                            BallPoints, AllOf, NoneOf>;
  std::vector<Part> parts;

  static PointSelection of(std::vector<int> indices) {
    return {{PointIndices{std::move(indices)}}};
  }
};

/// The selected control points, each once: in the order of the list if the selection consists of
/// numbers only, otherwise ascending.
/// Throws ModelingError that begins with `path` if an index or a row is out of range, a patch does
/// not exist, a limit is not finite, or no point is selected.
std::vector<int> selectPoints(const PointSelection& selection, const Solid& solid,
                              const std::string& path = "points");

}  // namespace palpa::modeling
