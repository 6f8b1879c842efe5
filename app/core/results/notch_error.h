#pragma once

#include "app/core/results/shape_error.h"

namespace palpa::app {

/// Relative error of the stiffness from notches (base/support_border.h) beside which elements have
/// no roots as coordinates: all of flat triangles, and those that a mesh of quadratic triangles
/// leaves out. The stress is unbounded there; within the height h of an element the energy is about
/// W h² per length with its density W beside the notch, of which polynomials miss a fixed part. The
/// residual of the equations hardly shows that. Measured on parts with steps, slots and grooves.
/// `energy`: of the field, mJ. 0 where nothing moves, and for splines.
double notchError(const BoundarySetup& setup, const EnergyDensity& density, double energy);

}  // namespace palpa::app
