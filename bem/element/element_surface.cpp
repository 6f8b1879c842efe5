#include "bem/element/element_surface.h"

#include "bem/element/gather.h"
#include "bem/model/surface_gradient.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

using Eigen::Index;
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
  state.gradient = surfaceGradient(at.frame, along, traction, material);
  return state;
}

}  // namespace palpa::bem
