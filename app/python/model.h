#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/core/design/stiffness_gradient.h"
#include "app/core/live/touchable_model.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/surface_sensor.h"
#include "app/core/results/touch.h"
#include "app/core/results/touch_batch.h"
#include "app/python/arrays.h"
#include "modeling/project/project.h"

namespace palpa::python {

/// A built model with the project that it was built from, and what touches need, made when it is
/// first needed. Several Python threads may use one model: long work of one model runs one after
/// the other.
class Model {
 public:
  Model(modeling::Project project, std::shared_ptr<const app::TouchModel> model)
      : project_(std::move(project)), model_(std::move(model)) {}

  const modeling::Project& project() const { return project_; }
  const app::TouchModel& model() const { return *model_; }

  // Called by working threads.
  std::shared_ptr<const app::TouchableModel> touchable();
  app::TouchState play(const std::vector<modeling::Touch>& touches, int steps, const Job& job);
  app::StiffnessGradient gradient(const app::TouchState::Contact& contact, const Job& job);

 private:
  const modeling::Project project_;
  const std::shared_ptr<const app::TouchModel> model_;
  std::mutex making_, playing_, deriving_;
  std::shared_ptr<const app::TouchableModel> touchable_;
  std::unique_ptr<app::TouchPlayer> player_;
  std::unique_ptr<app::StiffnessGradients> gradients_;
};

/// Adds the classes Model, State, Batch and Sensor to the module.
void bindModel(pybind11::module_& module);

}  // namespace palpa::python
