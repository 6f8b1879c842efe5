#include "bem/gradient/residual_shape.h"

#include "bem/gradient/residual_derivative.h"
#include "bem/model/collocation.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/quadratic/quadratic_quadrature.h"
#include "bem/quadratic/quartered_mesh.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

class SplineShape final : public ResidualShape {
 public:
  SplineShape(const SplineDiscretisation& on, const DegreesOfFreedom& dofs,
              const Material& material, double tolerance, const Job& job)
      : on_(on),
        material_(material),
        quadrature_(on.surface(), tolerance, job),
        motion_(on.surface()),
        equations_(splineEquations(on.surface(), on.tractions(), dofs.extraSlots())) {}

  Matrix3Xd derivative(const VectorXd& lambda, const VectorXd& u, const VectorXd& p,
                       const Job& job) const override {
    return residualDerivative(on_.elements(), quadrature_, motion_, equations_, lambda, u, p,
                              material_, job);
  }
  const MovingSplines* splines() const override { return &motion_; }

 private:
  const SplineDiscretisation& on_;
  Material material_;
  SplineQuadrature quadrature_;
  MovingSplines motion_;
  WeightedEquations equations_;
};

class QuadraticShape final : public ResidualShape {
 public:
  QuadraticShape(const QuadraticDiscretisation& on, const DegreesOfFreedom& dofs,
                 const Material& material, double tolerance)
      : on_(on),
        material_(material),
        quadrature_(on.surface(), tolerance),
        motion_(on.surface()),
        equations_(atPoints(quadraticEquations(on.surface(), on.mesh(), on.slots(), dofs))) {}

  Matrix3Xd derivative(const VectorXd& lambda, const VectorXd& u, const VectorXd& p,
                       const Job& job) const override {
    return residualDerivative(on_.surface(), quadrature_, motion_, equations_, lambda, u, p,
                              material_, job);
  }

 private:
  const QuadraticDiscretisation& on_;
  Material material_;
  QuadraticQuadrature quadrature_;
  MovingTriangles motion_;
  WeightedEquations equations_;
};

/// Flat triangles with nodes in the middles of their edges, where all values are means.
class FlatShape final : public ResidualShape {
 public:
  FlatShape(const TriangleDiscretisation& on, const DegreesOfFreedom& dofs,
            const Material& material, double tolerance)
      : on_(on),
        material_(material),
        quartered_(quarteredMesh(
            on.mesh(),
            [&](int t, int edge, double) -> Vector3d {
              const auto& c = on.mesh().triangles[t];
              return (on.mesh().nodes[c[edge]] + on.mesh().nodes[c[(edge + 1) % 3]]) / 2;
            },
            {}, true)),
        slots_(quartered_),
        surface_(quartered_, slots_, {}, true),
        quadrature_(surface_, tolerance),
        motion_(surface_) {
    std::vector<CollocationPlace> points;
    for (const CollocationPoint& point : dofs.collocationPoints(on.mesh(), on.slots()))
      points.push_back(surface_.placesAt({point.triangle, point.weights[1], point.weights[2]}));
    equations_ = collocationEquations(std::move(points));
  }

  Matrix3Xd derivative(const VectorXd& lambda, const VectorXd& u, const VectorXd& p,
                       const Job& job) const override {
    VectorXd allU = VectorXd::Zero(3 * surface_.coefficientCount());
    VectorXd allP = VectorXd::Zero(3 * slots_.count());
    allU.head(u.size()) = u;
    for (int t = 0; t < on_.mesh().triangleCount(); ++t) {
      const auto& nodes = on_.mesh().triangles[t];
      const auto& from = on_.slots().ofCorner[t];
      const std::vector<int>&middles = surface_.coefficients(t), &to = surface_.slots(t);
      const auto at = [](int k) { return 3 * static_cast<Index>(k); };
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        allU.segment<3>(at(middles[3 + k])) =
            (u.segment<3>(at(nodes[k])) + u.segment<3>(at(nodes[next]))) / 2;
        allP.segment<3>(at(to[k])) = p.segment<3>(at(from[k]));
        allP.segment<3>(at(to[3 + k])) =
            (p.segment<3>(at(from[k])) + p.segment<3>(at(from[next]))) / 2;
      }
    }
    const Matrix3Xd all = residualDerivative(surface_, quadrature_, motion_, equations_, lambda,
                                             allU, allP, material_, job);
    // The middles move with the corners.
    Matrix3Xd result = all.leftCols(on_.mesh().nodeCount());
    std::vector<bool> isDone(static_cast<std::size_t>(surface_.coefficientCount()), false);
    for (int t = 0; t < on_.mesh().triangleCount(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int middle = surface_.coefficients(t)[3 + k];
        if (isDone[middle]) continue;
        isDone[middle] = true;
        for (const int end : {on_.mesh().triangles[t][k], on_.mesh().triangles[t][(k + 1) % 3]})
          result.col(end) += all.col(middle) / 2;
      }
    return result;
  }

 private:
  const TriangleDiscretisation& on_;
  Material material_;
  BoundaryMesh quartered_;
  TractionSlots slots_;
  QuadraticSurface surface_;
  QuadraticQuadrature quadrature_;
  MovingTriangles motion_;
  WeightedEquations equations_;
};

}  // namespace

std::unique_ptr<ResidualShape> makeResidualShape(const Discretisation& discretisation,
                                                 const DegreesOfFreedom& dofs,
                                                 const Material& material, double tolerance,
                                                 const Job& job) {
  if (const auto* splines = dynamic_cast<const SplineDiscretisation*>(&discretisation))
    return std::make_unique<SplineShape>(*splines, dofs, material, tolerance, job);
  if (const auto* quadratic = dynamic_cast<const QuadraticDiscretisation*>(&discretisation))
    return std::make_unique<QuadraticShape>(*quadratic, dofs, material, tolerance);
  return std::make_unique<FlatShape>(dynamic_cast<const TriangleDiscretisation&>(discretisation),
                                     dofs, material, tolerance);
}

}  // namespace palpa::bem
