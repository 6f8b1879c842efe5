#include "bem/element/element_surface.h"

#include "bem/element/gather.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d weightedSum(const std::vector<double>& weights, const std::vector<int>& indices,
                     const VectorXd& all) {
  Vector3d total = Vector3d::Zero();
  for (std::size_t f = 0; f < weights.size(); ++f)
    total += weights[f] * all.segment<3>(3 * static_cast<Index>(indices[f]));
  return total;
}

Eigen::Matrix3Xd ElementSurface::displacementsOfTable(int element, const VectorXd& u) const {
  return gather(u, coefficients(element));
}

Eigen::Matrix3Xd ElementSurface::tractionsOfTable(int element, const VectorXd& p) const {
  Eigen::Matrix3Xd tractions = gather(p, slots(element));
  const std::span<const double> factors = tractionFactors(element);
  for (std::size_t f = 0; f < factors.size(); ++f)
    tractions.col(static_cast<Index>(f)) *= factors[f];
  return tractions;
}

SurfaceState ElementSurface::state(const ElementPlace& place, const VectorXd& u, const VectorXd& p,
                                   const Material& material) const {
  const SurfaceTangents at = tangents(place);
  const std::vector<int>& functions = coefficients(place.element);
  SurfaceState state;
  state.position = at.position;
  state.displacement = weightedSum(at.values, functions, u);
  const Vector3d traction = weightedSum(at.tractionValues.empty() ? at.values : at.tractionValues,
                                        slots(place.element), p);
  const Eigen::Matrix<double, 3, 2> along = gather(u, functions) * at.slopes.transpose();
  state.stress = surfaceStress(at.frame, along, traction, material);

  // Normal derivatives: p_a = G (u_a,n + u_n,a) and p_n = 2 G [e_nn + nu / (1 - 2 nu) e_kk].
  const double nu = material.poissonRatio, shear = material.shear();
  const Vector3d inFrame = at.frame.transpose() * traction;
  Matrix3d local;
  local.leftCols<2>() = at.frame.transpose() * along;
  for (int a = 0; a < 2; ++a) local(a, 2) = inFrame[a] / shear - local(2, a);
  local(2, 2) =
      ((1 - 2 * nu) * inFrame[2] / (2 * shear) - nu * (local(0, 0) + local(1, 1))) / (1 - nu);
  state.gradient = at.frame * local * at.frame.transpose();
  return state;
}

}  // namespace palpa::bem
