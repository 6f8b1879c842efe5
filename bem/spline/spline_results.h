#pragma once

#include <optional>

#include "bem/problem/reference_problem.h"
#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/triangle/results.h"

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

  /// The residuals r of fields, averaged over the surface with each function N_j: component c of
  /// function j in row 3 j + c, a column per field. About 4 µs per pair of elements and core.
  /// Throws Cancelled.
  Eigen::MatrixXd averageResidual(const BoundaryField& field, const Material& material,
                                  const Job& job) const;

  /// Somigliana's identities u = ∫ U p - ∫ T u, sigma = ∫ D p - ∫ S u for what is left of the
  /// fields after the linear field of the nearest surface point has been taken away, which fulfils
  /// them exactly: so integrands stay bounded as x approaches the surface, and the state goes over
  /// into that on the surface. Empty for a point outside the body. About 5 µs per element.
  std::optional<InteriorState> interiorState(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                             const Material& material,
                                             const Eigen::Vector3d& x) const;

 private:
  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  SplineQuadrature quadrature_;
};

/// See Discretisation::estimatedError(): A0 v = r̄ with the averaged residuals in the rows of the
/// functions' collocation points.
BoundaryField estimatedError(const SplineResults& results, const ReferenceProblem& problem,
                             const BoundaryField& field, const Material& material, const Job& job);

}  // namespace palpa::bem
