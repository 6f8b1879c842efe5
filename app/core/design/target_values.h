#pragma once

#include <vector>

#include "app/core/model/touch_model.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// What a touch of a target feels like on a model.
struct TargetValue {
  double value = 0;             ///< N/mm or N, as DesignTarget::value
  TouchState::Contact contact;  ///< of the touch, at the depth of the target
};

/// Values of targets, in their order. Their touches must exist in the project, of which `model` is.
/// All touches are played together, once for each depth that differs from the touch. Throws as
/// playTouches().
std::vector<TargetValue> targetValues(const modeling::Project& project, const TouchModel& model,
                                      const std::vector<modeling::DesignTarget>& targets,
                                      const Job& job = {});

}  // namespace palpa::app
