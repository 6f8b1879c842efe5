#include "modeling/mesh/border_slide.h"

#include <Eigen/LU>
#include <cmath>

namespace palpa::modeling {

// Inside a patch the step is δ = G⁻¹ Jᵀ Nᵀ λ with (N J G⁻¹ Jᵀ Nᵀ) λ = -value, where J = (du dv), G
// = Jᵀ J and the rows of N are the gradients; on a side the same with a single parameter.
bool slideOntoBorders(const SurfaceEvaluator& surface, bool staysOnSide,
                      std::span<const RegionBorder* const> borders, double tolerance,
                      SurfaceParameter& at) {
  constexpr int kIterations = 25;
  const auto count = static_cast<Eigen::Index>(borders.size());
  const auto [uLow, uHigh] = surface.range(at.patch, 0);
  const auto [vLow, vHigh] = surface.range(at.patch, 1);
  const bool alongU = !staysOnSide || at.v == vLow || at.v == vHigh;
  const bool alongV = !staysOnSide || !alongU;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const SurfacePoint p = surface.evaluate(at.patch, at.u, at.v);
    Eigen::MatrixXd normals(count, 3);
    Eigen::VectorXd values(count);
    bool converged = true;
    for (Eigen::Index k = 0; k < count; ++k) {
      normals.row(k) = borders[k]->gradient(p.position).transpose();
      values[k] = borders[k]->value(p.position);
      converged = converged && std::abs(values[k]) <= tolerance * borders[k]->slope();
    }
    if (converged) return true;
    Eigen::Matrix<double, 3, 2> jacobian;
    jacobian << p.du, p.dv;
    if (!alongU) jacobian.col(0).setZero();
    if (!alongV) jacobian.col(1).setZero();
    Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
    metric.diagonal().array() += 1e-12 * metric.trace();
    const Eigen::MatrixXd toParameters = metric.inverse() * (normals * jacobian).transpose();
    const Eigen::MatrixXd system = normals * jacobian * toParameters;
    const Eigen::Vector2d step = toParameters * system.fullPivLu().solve(-values);
    if (!step.allFinite()) return false;
    if (alongU) at.u += step[0];
    if (alongV) at.v += step[1];
    if ((alongU && !(at.u > uLow && at.u < uHigh)) || (alongV && !(at.v > vLow && at.v < vHigh)))
      return false;
  }
  return false;
}

}  // namespace palpa::modeling
