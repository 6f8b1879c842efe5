#pragma once

#include "app/core/design/contact_stiffness.h"
#include "app/core/design/design_surface.h"
#include "bem/gradient/boundary_form.h"
#include "modeling/editing/nearest_on_patches.h"

namespace palpa::app {

/// Boundary form of gradients of stiffnesses by the control points, prepared for one model:
/// StiffnessGradients::boundaryForm(). Immutable; const use from several threads is safe.
class BoundaryGradient {
 public:
  /// Both must outlive the object; `surface` is the model's. Takes about 1 µs per point.
  BoundaryGradient(const DesignSurface& surface, const TouchModel& model);

  /// N/mm per mm, one column per control point. Throws Cancelled.
  Eigen::Matrix3Xd of(const ContactStiffness& stiffness, const Job& job = {}) const;

 private:
  const TouchModel& model_;
  bem::BoundaryForm form_;
  modeling::NearestOnPatches nearest_;  ///< copied for each use, as it keeps its last place
};

}  // namespace palpa::app
