#pragma once

#include <memory>

#include "app/core/live/touch_snapshot.h"
#include "app/core/live/touchable_model.h"
#include "app/core/model/touch_model.h"
#include "bem/contact/contact_surface.h"
#include "bem/contact/field_evaluator.h"

namespace palpa::app {

/// A contact of a snapshot as a state describes it, without a name. `surface`: of its model.
TouchState::Contact contactOf(const TouchSnapshot& snapshot, const TouchSnapshot::Contact& from,
                              const bem::ContactSurface& surface);

/// Computes the whole field of a snapshot of a touch loop, at display rate, on any one thread other
/// than the loop's. Only for snapshots of its model (TouchLoop::model()).
class TouchField {
 public:
  explicit TouchField(std::shared_ptr<const TouchableModel> model);

  const std::shared_ptr<const TouchableModel>& model() const { return model_; }

  /// Displacements only. Cost: three columns of numbers per mask at rest.
  const Eigen::MatrixXd& displacements(const TouchSnapshot& snapshot);
  /// Displacements and tractions.
  const bem::BoundaryField& field(const TouchSnapshot& snapshot);
  /// Field, reactions of the supports, energy and balance.
  TouchState describe(const TouchSnapshot& snapshot);

 private:
  std::shared_ptr<const TouchableModel> model_;
  bem::FieldEvaluator evaluator_;
  bem::BoundaryField field_;
};

}  // namespace palpa::app
