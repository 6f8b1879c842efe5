#pragma once

#include "bem/spline/spline_equations.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem {

/// The same operators as assemble(), in the coefficients of the splines: with N_j the functions of
/// the surface and u = Σ N_j u_j, p = Σ N_s p_s,
///   H_ij = ∫ T(x_i, y) [N_j(y) - N_j(x_i)] dΓ,  G_is = ∫ U(x_i, y) N_s(y) dΓ,
/// the regularised identity: no free term, no principal value, valid at edges and corners. The
/// subtraction is done on the sums over all elements, so that a translation gives zero whatever the
/// quadrature errs. Rows and columns as in BoundaryOperators. About 0.4 µs per (point, element) and
/// core with cubic splines and a tolerance of 1e-5. The result does not depend on the number of
/// threads. Throws Cancelled.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const std::vector<SplineCollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job);
/// The rows of equations: weighted sums of those of points.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const SplineEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job);

/// What some elements add to the rows of equations whose points they do not contain: see the
/// assemblePart() of triangles.
template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const SplineSurface& surface,
                                       const SplineTractions& tractions, const ElementPart& part,
                                       const SplineEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job);

}  // namespace palpa::bem
