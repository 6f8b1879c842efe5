#include "bem/quadratic/quadratic_assembly.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bem/model/collocation.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

namespace {

using Eigen::Vector2d;

/// Collocation point of a node on the border of a support, where the metric of its elements is
/// singular: in an element of the support, at a quarter of the way from the border edge to the next
/// node in local coordinates. The node's displacement is known there, its traction is not. Where
/// the border crosses a sharp edge, the element is of the face whose slot is not extra: the extra
/// slot has another point, on its face.
CollocationPlace besideBorder(const QuadraticSurface& surface, int node,
                              const std::vector<bool>& isExtra) {
  constexpr double kRoot = 0.25, kAside = 0.1;
  int best = -1;
  std::pair<bool, double> most{false, -1};
  for (const int e : surface.around(node)) {
    const ElementPlace place = surface.placeOf(node, e);
    if (!surface.hasBorderTractions(e) || surface.coordinates(e).root({place.u, place.v}) != 0)
      continue;
    const auto& nodes = surface.coefficients(e);
    const auto corner = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
    // The largest element: its middle is the farthest from the border.
    const std::pair rank(!isExtra[surface.slots(e)[corner]],
                         surface.evaluate({e, 1.0 / 3, 1.0 / 3}).areaVector().norm());
    if (rank > most) {
      most = rank;
      best = e;
    }
  }
  const ElementPlace at = surface.placeOf(node, best);
  const Vector2d from(at.u, at.v), middle(1.0 / 3, 1.0 / 3);
  const Vector2d aside = from + kAside * (middle - from);
  const Vector2d inside = surface.coordinates(best).awayFromBorder(aside, kRoot);
  return surface.placesAt({best, inside[0], inside[1]});
}

/// How far the points of extra slots lie from their nodes: a tenth of the element. Twice as far,
/// some tractions on both faces of a sharp edge in a support nearly cancel at all points.
constexpr double kShift = 0.2;

}  // namespace

WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, std::span<const int> extraSlots) {
  const auto insideFace = [&](int slot) {
    const CollocationPoint onMesh = shiftedCollocation(mesh, slots, slot, kShift);
    return surface.placesAt(QuadraticSurface::place(onMesh.triangle, onMesh.weights));
  };
  std::vector<bool> isExtra(static_cast<std::size_t>(slots.count()), false);
  for (const int slot : extraSlots) isExtra[slot] = true;
  std::vector<CollocationPlace> points;
  for (int node = 0; node < surface.coefficientCount(); ++node) {
    int own = -1;
    bool hasExtra = false;
    for (int slot = slots.firstOfNode[node]; slot < slots.firstOfNode[node + 1]; ++slot) {
      hasExtra = hasExtra || isExtra[slot];
      if (own < 0 && !isExtra[slot]) own = slot;
    }
    if (surface.isOnBorder(node))
      points.push_back(besideBorder(surface, node, isExtra));
    else if (hasExtra && own >= 0)
      points.push_back(insideFace(own));
    else
      points.push_back(surface.collocationAt(node));
  }
  for (const int slot : extraSlots) points.push_back(insideFace(slot));
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
