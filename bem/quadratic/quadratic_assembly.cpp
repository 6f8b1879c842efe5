#include "bem/quadratic/quadratic_assembly.h"

#include "bem/model/collocation.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

namespace {

using Eigen::Vector2d;

/// Collocation point of a node on the border of a support, where the metric of its elements is
/// singular: in an element of the support, at a quarter of the way from the border edge to the next
/// node in local coordinates. The node's displacement is known there, its traction is not.
CollocationPlace besideBorder(const QuadraticSurface& surface, int node) {
  constexpr double kRoot = 0.25, kAside = 0.1;
  int best = -1;
  double nearest = -1;
  for (const int e : surface.around(node)) {
    const ElementPlace place = surface.placeOf(node, e);
    const bool hasEdge = surface.hasBorderTractions(e);
    if (!hasEdge) continue;
    // The element whose middle is the farthest from the border.
    const double size = surface.evaluate({e, 1.0 / 3, 1.0 / 3}).areaVector().norm();
    if (surface.coordinates(e).root({place.u, place.v}) == 0 && size > nearest) {
      nearest = size;
      best = e;
    }
  }
  const ElementPlace at = surface.placeOf(node, best);
  const Vector2d from(at.u, at.v), middle(1.0 / 3, 1.0 / 3);
  const Vector2d aside = from + kAside * (middle - from);
  const Vector2d inside = surface.coordinates(best).awayFromBorder(aside, kRoot);
  return surface.placesAt({best, inside[0], inside[1]});
}

}  // namespace

WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, std::span<const int> extraSlots) {
  std::vector<CollocationPlace> points;
  for (int node = 0; node < surface.coefficientCount(); ++node)
    points.push_back(surface.isOnBorder(node) ? besideBorder(surface, node)
                                              : surface.collocationAt(node));
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
