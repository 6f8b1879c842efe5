#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// A surface point as a sum of control points: their indices and weights.
using SurfaceSum = std::vector<std::pair<int, double>>;

/// Finds surface points of a solid that are nearest to points in space: from the nearest of many
/// samples by Gauss and Newton's method, then the same from spans that may come nearer. Exact to
/// rounding for points on the surface; where the surface bends as strongly as the point is far off,
/// the method converges slowly and ends early. Refers to the solid.
class NearestOnPatches {
 public:
  /// Samples the surface: about 0.02 µs per sample.
  explicit NearestOnPatches(const Solid& solid);

  /// Faster when points that follow each other are near to each other.
  SurfaceSum of(const Eigen::Vector3d& x);

 private:
  struct Sample {
    int patch;
    double u;
    double v;
    Eigen::Vector3d position;
  };
  /// One span of a patch in both directions: samples up to `end` from that of the cell before.
  struct Cell {
    int patch;
    std::size_t end;
    Eigen::Vector3d low;
    Eigen::Vector3d high;
  };

  void addPatch(int patch);
  void look(std::size_t cell, const Eigen::Vector3d& x, double& least, std::size_t& best) const;
  double squaredDistance(std::size_t cell, const Eigen::Vector3d& x) const;
  void improve(Sample& at, const Eigen::Vector3d& x) const;

  const Solid& solid_;
  std::vector<Sample> samples_;
  std::vector<Cell> cells_;
  std::size_t likelyCell_ = 0;
};

}  // namespace palpa::modeling
