#include "app/core/results/largest_displacement.h"

namespace palpa::app {

LargestDisplacement largestDisplacement(const TouchModel& model, const TouchState& state) {
  LargestDisplacement largest;
  const Eigen::MatrixXd u = model.setup().discretisation->valuesOnMesh(state.field).u;
  for (int node = 0; node < model.setup().mesh().nodeCount(); ++node) {
    const double length = u.col(0).segment<3>(3 * node).norm();
    if (length > largest.length) largest = {length, model.setup().mesh().nodes[node]};
  }
  return largest;
}

}  // namespace palpa::app
