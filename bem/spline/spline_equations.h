#pragma once

#include <span>

#include "bem/element/element_equations.h"
#include "bem/spline/spline_collocation.h"

namespace palpa::bem {

/// Equations for the unknowns: one per displacement coefficient, then one per extra traction slot
/// (`extraSlots`: DegreesOfFreedom::extraSlots()).
///
/// Most equations are collocation equations: one point of weight 1. Functions torn by the border of
/// a support (SplineSurface::isTorn) keep pieces of arbitrary shape, for which no choice of single
/// points is safe: with Greville points moved to the side of the piece, errors were up to a hundred
/// times larger and condition numbers reached 1e13. Their equations are Galerkin equations, ∫ N_k r
/// dΓ = 0 over the side of the piece with the Gauss points of its elements. The solution is then as
/// accurate as the functions can represent it, for any border.
WeightedEquations splineEquations(const SplineSurface& surface, const SplineTractions& tractions,
                                  std::span<const int> extraSlots);

}  // namespace palpa::bem
