#pragma once

#include "bem/element/element_assembly.h"
#include "bem/model/boundary_conditions.h"
#include "bem/quadratic/quadratic_surface.h"

namespace palpa::bem {

/// Equations for the unknowns: collocation at the nodes, then at one point per extra traction slot
/// (`extraSlots`: DegreesOfFreedom::extraSlots()) inside the slot's part of the surface. `mesh` and
/// `slots`: of the surface.
WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, std::span<const int> extraSlots);

/// Boundary operators in the coefficients of quadratic triangles, see element_assembly.h.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const QuadraticSurface& surface,
                                   const WeightedEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job);

/// Contribution of some elements to the rows of equations whose points lie outside these elements.
template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const QuadraticSurface& surface, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job);

}  // namespace palpa::bem
