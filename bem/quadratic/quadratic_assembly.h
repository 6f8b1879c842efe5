#pragma once

#include "bem/element/element_assembly.h"
#include "bem/model/boundary_conditions.h"
#include "bem/quadratic/quadratic_surface.h"

namespace palpa::bem {

/// True for the nodes whose equations are averaged: all but those with extra tractions, on sharp
/// edges within supports. Supports, too: residuals that remain there turn thin parts elsewhere.
std::vector<bool> averagedNodes(const QuadraticSurface& surface, const TractionSlots& slots,
                                const DegreesOfFreedom& dofs);

/// Share of the elements over thin walls and leads, whose equations are integrated at all points
/// (decision 095), 0 … 1. Estimated from a thousand elements.
double thinShare(const QuadraticSurface& surface);

/// Equations for the unknowns. First one per node: at averagedNodes() the mean of the residual
/// around the node, at others collocation. Then collocation at one point per extra traction slot
/// inside the slot's part of the surface. `mesh` and `slots`: of the surface; `dofs`: of its
/// discretisation.
WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, const DegreesOfFreedom& dofs);

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
