#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Position and first derivatives of a patch at (u, v), in mm per unit of the parameters.
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d du;
  Eigen::Vector3d dv;
};

/// Evaluates the patches of a solid through OpenCASCADE. Parameters are those of the knots; values
/// outside the range are moved to its end. Holds copies: the solid may go away. Const use from
/// several threads is safe. Cost: about a microsecond per point.
class SurfaceEvaluator {
 public:
  explicit SurfaceEvaluator(const Solid& solid);
  /// For patches that pass checkPatches() but are not yet a solid.
  SurfaceEvaluator(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

  int patchCount() const;
  std::array<double, 2> range(int patch, int direction) const;
  /// Distinct knots of a direction, ends included: the borders of the polynomial spans.
  const std::vector<double>& spans(int patch, int direction) const;
  int degree(int patch, int direction) const;

  Eigen::Vector3d position(int patch, double u, double v) const;
  SurfacePoint evaluate(int patch, double u, double v) const;

  /// Unit normal du × dv, outwards. Where the derivatives are parallel (the corners of a round cap
  /// made from one patch) it is taken a little inside; zero only if the patch is degenerate there
  /// as well.
  Eigen::Vector3d normal(int patch, double u, double v) const;

 private:
  struct Surfaces;
  std::shared_ptr<const Surfaces> surfaces_;
};

}  // namespace palpa::modeling
