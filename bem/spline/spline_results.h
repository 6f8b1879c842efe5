#pragma once
#include <optional>

#include "bem/results.h"
#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

/// What boundary integrals tell of fields in spline coefficients: u (3 per displacement
/// coefficient, mm) and p (3 per traction slot, MPa). Surface and tractions must outlive it; const
/// use from several threads is safe. Integrals over elements to 1e-6.
class SplineResults {
 public:
  SplineResults(const SplineSurface& surface, const SplineTractions& tractions,
                const Job& job = {});

  /// C^-1 r, mm: what one more iterate, C u'(x) = ∫ U p - ⨍ T u, changes u by at a point x of the
  /// surface, with the residual of the regularised identity
  ///   r(x) = ∫ U p dΓ - ∫ T [u(y) - u(x)] dΓ
  /// and the free term C (1/2 at smooth points). r is zero at collocation points. About 1 µs per
  /// element.
  Eigen::Vector3d displacementDefect(const SplineMesh::Point& at, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& p, const Material& material) const;

  /// Somigliana's identities u = ∫ U p - ∫ T u, sigma = ∫ D p - ∫ S u for what is left of the
  /// fields after the linear field of the nearest surface point has been taken away, which fulfils
  /// them exactly: so integrands stay bounded as x approaches the surface, and the state goes over
  /// into that on the surface. Empty for a point outside the body. About 10 µs per element.
  std::optional<InteriorState> interiorState(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                             const Material& material,
                                             const Eigen::Vector3d& x) const;

 private:
  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  SplineQuadrature quadrature_;
};

}  // namespace palpa::bem
