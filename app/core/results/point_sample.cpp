#include "app/core/results/point_sample.h"

#include "bem/problem/interior_evaluator.h"

namespace palpa::app {

PointSample sampleSurface(const TouchModel& model, const bem::BoundaryField& field,
                          const std::vector<Eigen::Matrix3d>& slotStress,
                          const bem::SurfacePoint& place) {
  const BoundarySetup& setup = model.setup();
  const bem::Discretisation& on = *setup.discretisation;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  const auto& slots = setup.meshSlots().ofCorner[static_cast<std::size_t>(place.triangle)];
  for (int k = 0; k < 3; ++k)
    stress +=
        place.weights[k] * slotStress[static_cast<std::size_t>(slots[static_cast<std::size_t>(k)])];
  return {
      place.position, on.interpolate(place, field.u.col(0)), on.tractionAt(place, field.p.col(0)),
      stress,         bem::strainOf(stress, setup.material), stressNumbers(stress)};
}

PointSample sampleInside(const TouchModel& model, const Eigen::Vector3d& at,
                         const bem::InteriorState& state) {
  return {at,
          state.displacement,
          std::nullopt,
          state.stress,
          bem::strainOf(state.stress, model.setup().material),
          stressNumbers(state.stress)};
}

}  // namespace palpa::app
