#pragma once

#include "app/core/live/touch_field.h"
#include "app/core/live/touch_stepper.h"

/// The laws of contact, written out and expected of what a stepper found, with either engine.
namespace palpa::app::test {

/// Signorini's and Coulomb's laws at every mask of the last step. Tolerances: the solver's 1e-9 of
/// the largest force, in mm by the stiffness of the softest place (0.5 N/mm).
void expectLaws(const bem::ContactSimulation& simulation);

/// How far a field was off: the largest values so far.
struct Equilibrium {
  double force = 0;     ///< of supports and contacts together, over the sum of the contacts' forces
  double moment = 0;    ///< the same about the origin, times the body's radius
  double position = 0;  ///< of masks from where the laws have them, over their largest displacement
};

/// The whole field from the tractions alone: how well supports and contacts balance on a body of
/// the given radius (mm) about the origin, and how far masks are from where the laws have them.
void measureEquilibrium(const TouchStepper& stepper, TouchField& field, double radius,
                        Equilibrium& largest);

}  // namespace palpa::app::test
