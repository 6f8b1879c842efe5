#pragma once

#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/results/touch.h"
#include "app/view/scene/scene.h"
#include "modeling/project/project.h"

namespace palpa::report {

/// Dimensions for the measurements of a project. At rest all of them; of a displaced body the
/// distances and wall thicknesses alone, between the displaced points, which are drawn with
/// displacements times `scale`. Measurements whose places are gone are left out.
std::vector<view::Dimension> dimensionsOf(const modeling::Project& project,
                                          const app::TouchModel& model,
                                          const app::TouchState& state, double scale);

}  // namespace palpa::report
