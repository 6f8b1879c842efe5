#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// A surface point as a sum of control points: their indices and weights.
using SurfaceSum = std::vector<std::pair<int, double>>;

/// Search for the nearest surface points of a solid: Gauss-Newton iteration from the nearest of
/// many samples, then from spans that may be nearer. Exact to rounding for points on the surface;
/// if the distance of a point is about the radius of curvature of the surface, the iteration
/// converges slowly and ends early. The solid must outlive the object. Not thread-safe.
class NearestOnPatches {
 public:
  /// Samples the surface. Cost: about 0.02 µs per sample.
  explicit NearestOnPatches(const Solid& solid);

  /// The surface point nearest to x. Faster if consecutive points are close together.
  SurfaceSum of(const Eigen::Vector3d& x);

 private:
  struct Sample {
    int patch;
    double u;
    double v;
    Eigen::Vector3d position;
  };
  /// One span of a patch in both directions, with the samples from the end of the previous cell to
  /// `end`, and their bounding box.
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
