#pragma once

#include <memory>

#include "bem/problem/discretisation.h"

namespace palpa::bem {

class MovingSplines;

/// The equations of a problem as functions of the shape (residual_derivative.h), for all three
/// discretisations. Flat triangles are taken as quadratic ones with straight edges; their integrals
/// agree to the tolerance. Immutable; const use from several threads is safe.
class ResidualShape {
 public:
  virtual ~ResidualShape() = default;

  /// Derivative of λ · (G p − H u) by the material points, one column each; see
  /// residualDerivative(). Throws Cancelled.
  virtual Eigen::Matrix3Xd derivative(const Eigen::VectorXd& lambda, const Eigen::VectorXd& u,
                                      const Eigen::VectorXd& p, const Job& job) const = 0;
  /// With splines the elements, whose places() are the material points; otherwise null: they are
  /// the nodes of the mesh.
  virtual const MovingSplines* splines() const { return nullptr; }
};

/// The discretisation and the problem's degrees of freedom must outlive the result. `tolerance`: of
/// the integrals.
std::unique_ptr<ResidualShape> makeResidualShape(const Discretisation& discretisation,
                                                 const DegreesOfFreedom& dofs,
                                                 const Material& material, double tolerance,
                                                 const Job& job);

}  // namespace palpa::bem
