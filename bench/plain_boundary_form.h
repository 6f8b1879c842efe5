#pragma once

#include <Eigen/Dense>

#include "app/core/design/contact_stiffness.h"
#include "app/core/design/design_surface.h"

namespace palpa::bench {

/// Processor time of the parts of plainBoundaryForm(), s.
struct PlainBoundaryTimes {
  double states = 0;   ///< displacement, gradient, stress and traction of both fields
  double density = 0;  ///< Eshelby's tensor at the points
  double masks = 0;    ///< motion of the masks
  double sum = 0;      ///< over the control points
};

/// Baseline: StiffnessGradients::boundaryForm() as in a plain program. States of both fields at all
/// points, then the density at all points, then the sum over the control points, each stored before
/// the next begins. `surface`: of the model. Runs on the job's threads where its parts do. `times`:
/// receives the parts; may be null.
Eigen::Matrix3Xd plainBoundaryForm(const app::DesignSurface& surface, const app::TouchModel& model,
                                   const app::ContactStiffness& stiffness, const Job& job = {},
                                   PlainBoundaryTimes* times = nullptr);

}  // namespace palpa::bench
