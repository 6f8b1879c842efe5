#include "bem/quadratic/quadratic_assembly.h"

#include "bem/model/collocation.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, std::span<const int> extraSlots) {
  std::vector<CollocationPlace> points;
  for (int node = 0; node < surface.coefficientCount(); ++node)
    points.push_back(surface.collocationAt(node));
  for (const int slot : extraSlots) {
    const CollocationPoint onMesh = shiftedCollocation(mesh, slots, slot);
    points.push_back(surface.placesAt(QuadraticSurface::place(onMesh.triangle, onMesh.weights)));
  }
  return collocationEquations(std::move(points));
}

template <class Scalar>
BoundaryOperators<Scalar> assemble(const QuadraticSurface& surface,
                                   const WeightedEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job) {
  const QuadraticQuadrature quadrature(surface, options.tolerance);
  return assemble<Scalar>(surface, quadrature, equations, material, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const QuadraticSurface& surface, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job) {
  const QuadraticQuadrature quadrature(surface, options.tolerance);
  return assemblePart<Scalar>(surface, quadrature, part, equations, material, job);
}

template BoundaryOperators<double> assemble(const QuadraticSurface&, const WeightedEquations&,
                                            const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const QuadraticSurface&, const WeightedEquations&,
                                           const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<double> assemblePart(const QuadraticSurface&, const ElementPart&,
                                                const WeightedEquations&, const Material&,
                                                const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemblePart(const QuadraticSurface&, const ElementPart&,
                                               const WeightedEquations&, const Material&,
                                               const AssemblyOptions&, const Job&);

}  // namespace palpa::bem
