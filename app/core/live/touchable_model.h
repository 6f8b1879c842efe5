#pragma once

#include <memory>

#include "app/core/model/touch_model.h"
#include "bem/contact/contact_simulation.h"
#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::app {

/// A model with everything needed to touch it at any place. Immutable except for the columns, which
/// one thread computes.
class TouchableModel {
 public:
  /// About 20 µs per triangle. `columns`: shared with a model of equal key; null: none yet. Throws
  /// SolverError (kTooLarge) if there is no memory for columns.
  explicit TouchableModel(std::shared_ptr<const TouchModel> model,
                          std::shared_ptr<bem::GreensColumns> columns = nullptr);
  TouchableModel(const TouchableModel&) = delete;
  TouchableModel& operator=(const TouchableModel&) = delete;

  const TouchModel& model() const { return *model_; }
  const std::shared_ptr<const TouchModel>& sharedModel() const { return model_; }
  const bem::ContactSurface& surface() const { return *surface_; }
  const std::shared_ptr<bem::GreensColumns>& columns() const { return columns_; }
  /// The field without contacts.
  const bem::BoundaryField& base() const { return model_->rest().field; }

  bem::ContactSimulation simulate() const {
    return {*surface_, *columns_, base(), model_->setup().material};
  }

 private:
  std::shared_ptr<const TouchModel> model_;
  std::unique_ptr<bem::ContactSurface> surface_;
  std::shared_ptr<bem::GreensColumns> columns_;
};

}  // namespace palpa::app
