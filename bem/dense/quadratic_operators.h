#pragma once

#include "bem/element/element_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"

namespace palpa::bem {

/// Dense operators of quadratic triangles, see assemble() in quadratic_assembly.h, whose products
/// with rigid motions are exact where rigidProducts() knows them. Throws Cancelled.
template <class Scalar>
BoundaryOperators<Scalar> makeQuadraticOperators(const QuadraticDiscretisation& on,
                                                 const WeightedEquations& equations,
                                                 const Material& material,
                                                 const AssemblyOptions& options, const Job& job);

}  // namespace palpa::bem
