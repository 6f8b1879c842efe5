#pragma once

#include "bem/element/element_equations.h"
#include "bem/element/element_quadrature.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem {

/// Boundary operators H and G on curved elements, corresponding to assemble() for flat triangles.
/// With the functions N_j of the surface and u = Σ N_j u_j, p = Σ N_s p_s,
///   H_ij = ∫ T(x_i, y) [N_j(y) - N_j(x_i)] dΓ,  G_is = ∫ U(x_i, y) N_s(y) dΓ.
/// This is the regularised identity: it has no free term and no principal value, and is valid at
/// edges and corners. The subtraction is applied to the sums over all elements, so a translation
/// gives exactly zero for any quadrature error. Rows and columns are ordered as in
/// BoundaryOperators; rows of equations are weighted sums of the rows of their points. The cost is
/// about 0.4 µs per (point, element) and core with cubic splines and a tolerance of 1e-5, and 0.1
/// µs with quadratic triangles. The result does not depend on the number of threads. Throws
/// Cancelled if the job was stopped.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const ElementSurface& surface,
                                   const ElementQuadrature& quadrature,
                                   const WeightedEquations& equations, const Material& material,
                                   const Job& job);

/// Contribution of some elements to the rows of equations whose points lie outside these elements;
/// see assemblePart() for flat triangles.
template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const ElementSurface& surface,
                                       const ElementQuadrature& quadrature, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const Job& job);

}  // namespace palpa::bem
