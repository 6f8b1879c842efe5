#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "modeling/solid/solid.h"

// Nearest points, rays and curvatures on the patches of a solid.
namespace palpa::modeling {

/// Position (mm) and derivatives of a patch, mm per unit of the parameters.
struct PatchJet {
  Eigen::Vector3d position, u, v, uu, uv, vv;
};

/// Point of a patch; u and v in the ranges of its knots, position in mm.
struct PatchPoint {
  int patch = -1;
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Search on the exact surface: quarters of the polynomial spans are found by their boxes, Newton's
/// method starts in each that may hold the result. Exact to rounding. A surface that bends by more
/// than half a turn within a quarter span may hide a second solution there. Immutable; several
/// threads may use it.
class PatchSearch {
 public:
  /// Cost: about 10 µs per span.
  explicit PatchSearch(const Solid& solid);
  ~PatchSearch();

  int patchCount() const;
  /// First and last knot of a direction: 0 for u, 1 for v.
  std::array<double, 2> range(int patch, int direction) const;
  /// Distinct knots, which bound the polynomial spans.
  const std::vector<double>& spans(int patch, int direction) const;
  PatchJet jet(int patch, const Eigen::Vector2d& uv) const;
  Eigen::Vector3d position(int patch, const Eigen::Vector2d& uv) const;

  /// Nearest point on a patch, or on all.
  PatchPoint nearest(int patch, const Eigen::Vector3d& x) const;
  PatchPoint nearest(const Eigen::Vector3d& x) const;
  /// Smallest s > `least` with origin + s direction on a patch; unit direction, mm.
  std::optional<double> firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double least) const;

  /// One point per quarter span.
  std::vector<Eigen::Vector3d> samples(int patch) const;
  /// Diagonal of the box around the samples, mm.
  double size() const { return size_; }

 private:
  struct Entry;
  void search(int patch, const Eigen::Vector3d& x, double& squared, PatchPoint& best) const;
  /// Gives up, with some squared distance above `limit`, where it cannot come below it.
  double improve(int patch, Eigen::Vector2d& uv, const Eigen::Vector3d& x, double limit) const;
  std::optional<double> hit(int patch, Eigen::Vector2d uv, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) const;

  std::vector<std::unique_ptr<Entry>> entries_;
  double size_ = 0;
};

}  // namespace palpa::modeling
