#pragma once

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// The displaced body as a solid of patches: the control points of the analysis net, moved by
/// `scale` times the displacement coefficients of a field of the model. As exact as the field: no
/// surface is fitted. Throws ModelingError when the model is one of triangles, or when the
/// displaced surface does not bound a body (turned inside out by a large scale).
modeling::Solid deformedSolid(const TouchModel& model, const bem::BoundaryField& field,
                              double scale = 1);

/// A project of the displaced body: its material and mesh settings, without supports, loads and
/// touches, which belong to the unloaded shape.
modeling::Project deformedProject(const modeling::Project& project, const TouchModel& model,
                                  const bem::BoundaryField& field, double scale = 1);

}  // namespace palpa::app
