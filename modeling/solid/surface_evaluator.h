#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Position (mm) and first derivatives (mm per unit of the parameters) of a patch at (u, v).
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d du;
  Eigen::Vector3d dv;
};

/// Evaluator of the patches of a solid by OpenCASCADE. Parameters lie in the knot ranges; values
/// outside the range are clamped. Stores copies, so the solid need not outlive it. Const use from
/// several threads is safe. Takes about a microsecond per point.
class SurfaceEvaluator {
 public:
  explicit SurfaceEvaluator(const Solid& solid);
  /// Evaluator for patches that pass checkPatches() but do not form a solid yet.
  SurfaceEvaluator(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

  int patchCount() const;
  std::array<double, 2> range(int patch, int direction) const;
  /// Distinct knots of a direction, ends included: the limits of the polynomial spans.
  const std::vector<double>& spans(int patch, int direction) const;
  int degree(int patch, int direction) const;

  /// Position at (u, v), mm.
  Eigen::Vector3d position(int patch, double u, double v) const;
  SurfacePoint evaluate(int patch, double u, double v) const;

  /// Unit normal du × dv, outwards. Where the derivatives are parallel (the corners of a round cap
  /// made of one patch) it is evaluated slightly inside; zero only if the patch is degenerate there
  /// too.
  Eigen::Vector3d normal(int patch, double u, double v) const;

 private:
  struct Surfaces;
  std::shared_ptr<const Surfaces> surfaces_;
};

}  // namespace palpa::modeling
