#pragma once

#include "bem/element/element_assembly.h"
#include "bem/spline/spline_equations.h"

namespace palpa::bem {

/// Boundary operators in spline coefficients, see element_assembly.h.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const WeightedEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job);

/// Contribution of some elements to the rows of equations whose points lie outside these elements.
template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const SplineSurface& surface,
                                       const SplineTractions& tractions, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job);

}  // namespace palpa::bem
