#include "bem/element/element_body_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/scratch_pool.h"

namespace palpa::bem {

using Eigen::Vector3d;

Vector3d ElementBodyForce::at(const CollocationPlace& x, ElementQuadrature::Workspace& work) const {
  if (!bulk_.hasBodyForce()) return Vector3d::Zero();
  const Vector3d& b = bulk_.bodyForce;
  double flux = 0;                       // ∮ e.n
  Vector3d weighted = Vector3d::Zero();  // ∮ e b.n
  for (int e = 0; e < elementCount_; ++e) {
    quadrature_.visitRules(e, x.position, placeIn(x, e), work, [&](const ElementPoints& points) {
      for (int k = 0; k < points.used; ++k) {
        double r[3], squared = 0, along = 0, load = 0;
        for (int c = 0; c < 3; ++c) {
          r[c] = points.position(c)[k] - x.position[c];
          squared += r[c] * r[c];
          along += r[c] * points.area(c)[k];
          load += b[c] * points.area(c)[k];
        }
        const double inverse = 1 / std::sqrt(squared);
        flux += along * inverse;
        load *= inverse;
        for (int c = 0; c < 3; ++c) weighted[c] += load * r[c];
      }
    });
  }
  return (flux * b - weighted / (2 * (1 - bulk_.material.poissonRatio))) /
         (8 * std::numbers::pi * bulk_.material.shear());
}

Eigen::VectorXd ElementBodyForce::term(const WeightedEquations& equations, const Job& job) const {
  constexpr std::ptrdiff_t kPerTask = 8;
  // Not interpolated between nodes, so that fields that the functions can represent are exact.
  const WeightedEquations pointwise = atPoints(equations);
  const auto count = static_cast<std::ptrdiff_t>(pointwise.points.size());
  Eigen::MatrixX3d values(count, 3);
  ScratchPool<std::unique_ptr<ElementQuadrature::Workspace>> pool(
      [this] { return quadrature_.makeWorkspace(); });
  parallelFor((count + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
    std::unique_ptr<ElementQuadrature::Workspace> work = pool.take();
    for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k)
      values.row(k) = at(pointwise.points[static_cast<std::size_t>(k)], *work).transpose();
    pool.giveBack(std::move(work));
  });
  const Eigen::MatrixX3d ofEquations = pointwise.weights * values;
  return Eigen::Map<const Eigen::VectorXd>(ofEquations.data(), ofEquations.size());
}

}  // namespace palpa::bem
