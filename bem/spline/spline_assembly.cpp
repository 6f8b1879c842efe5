#include "bem/spline/spline_assembly.h"

#include "bem/spline/spline_elements.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const WeightedEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job) {
  const SplineQuadrature quadrature(surface, options.tolerance, job);
  return assemble<Scalar>(SplineElements(surface, tractions), quadrature, equations, material, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const SplineSurface& surface,
                                       const SplineTractions& tractions, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job) {
  const SplineQuadrature quadrature(surface, options.tolerance, job);
  return assemblePart<Scalar>(SplineElements(surface, tractions), quadrature, part, equations,
                              material, job);
}

template BoundaryOperators<double> assemble(const SplineSurface&, const SplineTractions&,
                                            const WeightedEquations&, const Material&,
                                            const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const SplineSurface&, const SplineTractions&,
                                           const WeightedEquations&, const Material&,
                                           const AssemblyOptions&, const Job&);
template BoundaryOperators<double> assemblePart(const SplineSurface&, const SplineTractions&,
                                                const ElementPart&, const WeightedEquations&,
                                                const Material&, const AssemblyOptions&,
                                                const Job&);
template BoundaryOperators<float> assemblePart(const SplineSurface&, const SplineTractions&,
                                               const ElementPart&, const WeightedEquations&,
                                               const Material&, const AssemblyOptions&, const Job&);

}  // namespace palpa::bem
