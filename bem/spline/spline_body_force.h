#pragma once

#include "bem/model/body_force.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

/// Term of a uniform body force in the boundary integral equation of spline elements, by the rules
/// of `SplineQuadrature`: its kernel is smoother than Kelvin's kernels, for which they were chosen.
/// Const use from several threads is safe; surface and quadrature must outlive it.
class SplineBodyForce {
 public:
  SplineBodyForce(const SplineSurface& surface, const SplineQuadrature& quadrature,
                  const Bulk& bulk)
      : surface_(surface), quadrature_(quadrature), bulk_(bulk) {}

  /// B(x), mm, at a point of the surface; zero without a body force. About 0.1 µs per element.
  Eigen::Vector3d at(const SplineCollocationPoint& x, SplineQuadrature::Workspace& work) const;
  /// The weighted sums of B in the rows of the equations: component c of equation k in row c m + k.
  /// Throws Cancelled.
  Eigen::VectorXd term(const SplineEquations& equations, const Job& job) const;

 private:
  const SplineSurface& surface_;
  const SplineQuadrature& quadrature_;
  Bulk bulk_;
};

/// Volume moments of the body, by Gauss rules of degree + 4 points per direction.
VolumeMoments volumeMoments(const SplineSurface& surface);

/// Work of a uniform body force, by the same rules.
BodyForceWork bodyForceWork(const SplineSurface& surface, const SplineTractions& tractions,
                            const Bulk& bulk);

}  // namespace palpa::bem
