#pragma once

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// The displaced body as a solid: the control points of the analysis net, moved by the displacement
/// coefficients of a field of the model. As exact as the field, because no surface is fitted.
/// Throws ModelingError if the model uses triangles, or if the displaced surface does not bound a
/// body.
modeling::Solid deformedSolid(const TouchModel& model, const bem::BoundaryField& field);

/// A project of the displaced body with the material and mesh settings of `project`, without
/// supports, loads and touches, which belong to the unloaded shape.
modeling::Project deformedProject(const modeling::Project& project, const TouchModel& model,
                                  const bem::BoundaryField& field);

}  // namespace palpa::app
