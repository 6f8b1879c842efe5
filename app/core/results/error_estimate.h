#pragma once

#include "app/core/model/touch_model.h"

// How accurate results are, estimated from the residual of the boundary integral equation between
// the collocation points: from the unknowns it calls for (bem::Discretisation::estimatedError())
// and from what it changes locally (displacementDefect()). Estimates, not bounds; tests compare
// them with exact and finer solutions.
namespace palpa::app {

/// Relative error of a state's displacements, and of the forces of its contacts, which are as far
/// off as the displacements they cause: the largest of the root mean squares over `samples` places
/// all over the surface and over the places of each contact, and of the forces that are missing to
/// equilibrium (which see the bending of slender bodies where the residual of triangles does not).
/// 0 when nothing moves. Costs about as
/// much as the assembly. Throws Cancelled.
double estimateError(const TouchModel& model, const TouchState& state, const Job& job = {},
                     int samples = 48);

/// Relative error of the force under a fingertip that presses the body anywhere: the largest of a
/// few presses spread over what is free of supports. Independent of loads. 0 when supports hold
/// everything. Costs some times as much as the assembly. Throws Cancelled.
double estimateTouchError(const TouchModel& model, const Job& job);

}  // namespace palpa::app
