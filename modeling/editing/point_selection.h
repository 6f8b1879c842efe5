#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/solid/solid.h"

// Which control points a command works on: by number, by their place in the nets, or by position.
namespace palpa::modeling {

struct PointSelection;

struct PointIndices {
  std::vector<int> indices;
};

/// All points of the nets of the named patches, borders included.
struct PatchPoints {
  std::vector<std::string> patches;
};

/// The row of points along one side of a patch: an edge of the solid.
struct SidePoints {
  std::string patch;
  Side side = Side::kVMin;
};

/// Points of one net: row i along u, row j along v; an absent number means all. Negative numbers
/// count from the end, -1 is the last.
struct NetPoints {
  std::string patch;
  std::array<std::optional<int>, 2> at;
};

/// Points x with above < normal · x < below; one of the limits may be absent. With a unit normal
/// the limits are distances from the origin in mm.
struct SlabPoints {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::optional<double> above;
  std::optional<double> below;
};

/// Points in an axis-parallel box, its faces included; mm.
struct BoxPoints {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// Points within a ball, its surface included; mm.
struct BallPoints {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
};

/// Points in every one of the selections.
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

/// The selected control points, each once: in the order of the list for numbers alone, ascending
/// otherwise. `path` begins messages.
/// @throws ModelingError: an index or a row out of range, a patch that does not exist, a limit that
///         is not finite, or no point selected at all
std::vector<int> selectPoints(const PointSelection& selection, const Solid& solid,
                              const std::string& path = "points");

}  // namespace palpa::modeling
