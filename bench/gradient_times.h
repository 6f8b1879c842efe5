#pragma once

#include <string>

#include "app/core/design/contact_stiffness.h"
#include "app/core/design/stiffness_gradient.h"

namespace palpa::bench {

/// Measures and prints the cost of one touch's gradient: the fields of the touch, the boundary form
/// of StiffnessGradients beside plainBoundaryForm(), in turn, by parts and with their difference,
/// its preparation, and the discrete adjoint. Processor times of all threads and times on the
/// clock, smallest and median of `repeats`. `project`: of the model.
void printGradientTimes(const std::string& name, const modeling::Project& project,
                        const app::TouchModel& model, const app::StiffnessRule& rule, int repeats,
                        const Job& job);

}  // namespace palpa::bench
