#pragma once

#include <memory>

#include "app/core/live/touch_snapshot.h"
#include "app/core/live/touchable_model.h"
#include "bem/contact/field_evaluator.h"

namespace palpa::app {

/// The whole field that belongs to a snapshot of a touch loop, at display rate and beside the loop,
/// on any one thread. For snapshots of its body only (TouchLoop::body()).
class TouchField {
 public:
  explicit TouchField(std::shared_ptr<const TouchableModel> body);

  const std::shared_ptr<const TouchableModel>& body() const { return body_; }

  /// Displacements alone: three columns of numbers per mask at rest.
  const Eigen::MatrixXd& displacements(const TouchSnapshot& snapshot);
  /// Displacements and tractions.
  const bem::BoundaryField& field(const TouchSnapshot& snapshot);
  /// Everything: the field, reactions of the supports, energy and balance.
  TouchState describe(const TouchSnapshot& snapshot);

 private:
  std::shared_ptr<const TouchableModel> body_;
  bem::FieldEvaluator evaluator_;
  bem::BoundaryField field_;
};

}  // namespace palpa::app
