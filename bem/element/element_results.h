#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bem/element/element_equations.h"
#include "bem/element/element_quadrature.h"
#include "bem/model/bulk.h"
#include "bem/problem/reference_problem.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

/// Results that boundary integrals give for fields in the coefficients of a surface: u (3 per
/// displacement coefficient, mm) and p (3 per traction slot, MPa). Surface and quadrature must
/// outlive the results; const use from several threads is safe.
class ElementResults {
 public:
  /// Tolerance of a quadrature for results.
  static constexpr double kTolerance = 1e-6;

  ElementResults(const ElementSurface& surface, const ElementQuadrature& quadrature)
      : surface_(surface), quadrature_(quadrature) {}

  /// C^-1 r, mm: the change of u at a surface point x by one more iteration C u'(x) = ∫ U p - ⨍ T
  /// u, with the residual of the regularised identity
  ///   r(x) = ∫ U p dΓ - ∫ T [u(y) - u(x)] dΓ + B(x)
  /// with the body force's term B (bem/model/body_force.h) and the free term C (1/2 at smooth
  /// points). r is zero at collocation points. Zero also where the metric of an element is singular
  /// (the corner of a round cap), where the integrals are inexact. Takes about 1 µs per element.
  Eigen::Vector3d displacementDefect(const CollocationPlace& at, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& p, const Bulk& bulk) const;

  /// Residuals r of fields, averaged over the surface with the shares of each coefficient:
  /// component c of coefficient j in row 3 j + c, one column per field. Takes about 4 µs per pair
  /// of elements and core, less from some hundreds of elements on. Throws Cancelled if the job was
  /// stopped.
  Eigen::MatrixXd averageResidual(const BoundaryField& field, const Bulk& bulk,
                                  const Job& job) const;

  /// Displacement and stress at a point x (mm) inside the body, by Somigliana's identities u = ∫ U
  /// p - ∫ T u, sigma = ∫ D p - ∫ S u. They are applied to the fields minus the linear field of the
  /// nearest surface point, which satisfies them exactly: so the integrands stay bounded as x
  /// approaches the surface, and the state converges to the surface state. Empty for a point
  /// outside the body. Takes about 5 µs per element.
  std::optional<InteriorState> interiorState(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                             const Bulk& bulk, const Eigen::Vector3d& x) const;

  /// Term of the body force in the rows of equations, see ElementBodyForce.
  Eigen::VectorXd bodyForceTerm(const WeightedEquations& equations, const Bulk& bulk,
                                const Job& job) const;

 private:
  /// r of fields at surface points that are no collocation points.
  std::vector<Eigen::Matrix3Xd> residuals(std::span<const CollocationPlace> points,
                                          const BoundaryField& field, const Bulk& bulk,
                                          const Job& job) const;
  bool isRegular(const CollocationPlace& at) const;

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
};

/// Error estimate, see Discretisation::estimatedError(): solves A0 v = r̄ with the averaged
/// residuals in the rows of the functions' equations, times `share`(function).
BoundaryField estimatedError(const ElementResults& results, const ReferenceProblem& problem,
                             const BoundaryField& field, const Bulk& bulk,
                             const std::function<double(int)>& share, const Job& job);

}  // namespace palpa::bem
