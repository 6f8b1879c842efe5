#include "bem/quadratic/quadratic_assembly.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bem/base/triangle_rule.h"
#include "bem/model/collocation.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

/// Whether tractions of a support are unbounded at a node: on its border, not at a notch.
bool isOnSupportBorder(const QuadraticSurface& surface, int node) {
  const auto& around = surface.around(node);
  return surface.isOnBorder(node) && std::any_of(around.begin(), around.end(), [&](int e) {
           const ElementPlace at = surface.placeOf(node, e);
           return surface.hasBorderTractions(e) && surface.coordinates(e).root({at.u, at.v}) == 0;
         });
}

/// How far the points of extra slots lie from their nodes: a tenth of the element. Twice as far,
/// some tractions on both faces of a sharp edge in a support nearly cancel at all points.
constexpr double kShift = 0.2;

/// A ball about an element, mm, and its unit normal in the middle.
struct Ball {
  Vector3d centre;
  double radius;
  Vector3d normal;
};
Ball ballAbout(const QuadraticSurface& surface, int element) {
  constexpr double kBulge = 1.05;  // the nodes are not quite the farthest points
  const SurfaceJet middle = surface.evaluate({element, 1.0 / 3, 1.0 / 3});
  Ball ball{middle.position, 0, middle.areaVector().normalized()};
  for (const int node : surface.coefficients(element))
    ball.radius = std::max(ball.radius, kBulge * (surface.nodes()[node] - ball.centre).norm());
  return ball;
}

/// Thickness of the body under an element, mm; infinite if no element faces away from it there.
double thicknessUnder(const std::vector<Ball>& balls, int element) {
  constexpr double kOpposite = -0.5;  // cosine of the normals
  const Ball& own = balls[element];
  double thickness = std::numeric_limits<double>::infinity();
  for (const Ball& other : balls) {
    if (own.normal.dot(other.normal) > kOpposite) continue;
    const Vector3d to = other.centre - own.centre;
    const double depth = -to.dot(own.normal), reach = own.radius + other.radius;
    if (depth > 0 && depth < thickness && to.squaredNorm() < depth * depth + reach * reach)
      thickness = depth;
  }
  return thickness;
}

/// True for elements of leads and walls. Interpolated kernels are not in balance: where an element
/// is long compared with the thickness, forces at the end of a lead were wrong by up to a factor
/// of three, and by 8 % even from a distance of twelve radii on.
bool isThin(const std::vector<Ball>& balls, int element) {
  constexpr double kThin = 0.25;  // radius over thickness
  return balls[element].radius > kThin * thicknessUnder(balls, element);
}

std::vector<Ball> ballsAbout(const QuadraticSurface& surface) {
  std::vector<Ball> balls;
  for (int e = 0; e < surface.elementCount(); ++e) balls.push_back(ballAbout(surface, e));
  return balls;
}

/// Distance over the radius of an element from which Kelvin's kernels are interpolated over it:
/// forces on eight parts change by 2e-5 of themselves in the median, displacements of a box under
/// even stress by 8e-5.
constexpr double kFar = 5;

std::vector<int> nearElements(const std::vector<Ball>& balls, int element) {
  std::vector<int> near;
  const Ball& own = balls[element];
  for (std::size_t e = 0; e < balls.size(); ++e) {
    const double reach = (1 + kFar) * own.radius + balls[e].radius;
    if ((balls[e].centre - own.centre).squaredNorm() < reach * reach)
      near.push_back(static_cast<int>(e));
  }
  return near;
}

/// (node, point): values of the polynomials of degree two that are 1 at one node of an element, at
/// local coordinates. Positions are such polynomials in geometric coordinates.
Eigen::MatrixXd interpolation(const QuadraticSurface& surface, int element,
                              const std::vector<CollocationPlace>& points) {
  const BorderCoordinates& coordinates = surface.coordinates(element);
  const auto powers = [&](const ElementPlace& place) {
    const Vector2d at = coordinates.geometric({place.u, place.v});
    return Eigen::Vector<double, 6>(1, at[0], at[1], at[0] * at[0], at[0] * at[1], at[1] * at[1]);
  };
  Eigen::Matrix<double, 6, 6> ofNodes;
  for (int f = 0; f < 6; ++f)
    ofNodes.col(f) = powers(surface.placeOf(surface.coefficients(element)[f], element));
  Eigen::MatrixXd ofPoints(6, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index q = 0; q < ofPoints.cols(); ++q)
    ofPoints.col(q) = powers(points[q].places.front());
  return ofNodes.partialPivLu().solve(ofPoints);
}

/// The equations of an element's nodes, with weights that are the hat functions of the nodes among
/// the quarters of the elements times the area; without near elements and nodes.
AveragedElement averagedOver(const QuadraticSurface& surface, int element,
                             const std::vector<bool>& isAveraged) {
  AveragedElement averaged;
  averaged.element = element;
  const std::vector<int>& nodes = surface.coefficients(element);
  std::vector<std::size_t> functions;
  for (std::size_t f = 0; f < nodes.size(); ++f)
    if (isAveraged[nodes[f]]) functions.push_back(f);
  for (const std::size_t f : functions) averaged.equations.push_back(nodes[f]);
  averaged.weights.resize(static_cast<Eigen::Index>(functions.size()),
                          static_cast<Eigen::Index>(triangleRule7().size()));
  std::vector<double> shares;
  for (const TrianglePoint& point : triangleRule7()) {
    const ElementPlace place{element, point.barycentric[1], point.barycentric[2]};
    const SurfaceJet jet = surface.evaluate(place);
    surface.evaluateShares(place, shares);
    for (std::size_t k = 0; k < functions.size(); ++k)
      averaged.weights(static_cast<Eigen::Index>(k),
                       static_cast<Eigen::Index>(averaged.points.size())) =
          point.weight * jet.areaVector().norm() * shares[functions[k]];
    averaged.points.push_back({jet.position, {place}});
  }
  averaged.interpolated = interpolation(surface, element, averaged.points);
  return averaged;
}

/// Replaces the collocation points of some nodes by the mean of the residual around them, weighted
/// with their hat functions. These reproduce rigid motions, so that sums of the residual over parts
/// of the body vanish: in a thin part, which hangs on the body by a small cross-section, the
/// balance of forces and moments decides how it moves. There kernels are integrated at all points;
/// over other elements the kernels of distant elements are interpolated between nodes. (With 3
/// points per element instead of 7 the equations are nearly dependent.)
WeightedEquations averaged(const QuadraticSurface& surface, std::vector<CollocationPlace> points,
                           const std::vector<bool>& isAveraged) {
  WeightedEquations equations;
  std::vector<Eigen::Triplet<double>> weights;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (k >= isAveraged.size() || !isAveraged[k]) {
      weights.emplace_back(static_cast<int>(k), static_cast<int>(equations.points.size()), 1);
      equations.points.push_back(std::move(points[k]));
    }
  const std::vector<Ball> balls = ballsAbout(surface);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(surface.coefficientCount());
  std::vector<int> pointOfNode(static_cast<std::size_t>(surface.coefficientCount()), -1);
  std::vector<AveragedElement> thin;
  for (int e = 0; e < surface.elementCount(); ++e) {
    AveragedElement element = averagedOver(surface, e, isAveraged);
    if (element.equations.empty()) continue;
    for (std::size_t k = 0; k < element.equations.size(); ++k)
      sums[element.equations[k]] += element.weights.row(static_cast<Eigen::Index>(k)).sum();
    if (isThin(balls, e)) {
      thin.push_back(std::move(element));
      continue;
    }
    element.near = nearElements(balls, e);
    for (const int node : surface.coefficients(e)) {
      if (pointOfNode[node] < 0) {
        pointOfNode[node] = static_cast<int>(equations.points.size());
        equations.points.push_back(surface.collocationAt(node));
      }
      element.nodes.push_back(pointOfNode[node]);
    }
    equations.averaged.push_back(std::move(element));
  }
  for (std::vector<AveragedElement>* elements : {&equations.averaged, &thin})
    for (AveragedElement& element : *elements)
      for (std::size_t k = 0; k < element.equations.size(); ++k)
        element.weights.row(static_cast<Eigen::Index>(k)) /= sums[element.equations[k]];
  for (const AveragedElement& element : thin) addPoints(element, equations.points, weights);
  setWeights(equations, static_cast<Eigen::Index>(points.size()), std::move(weights));
  return equations;
}

}  // namespace

double thinShare(const QuadraticSurface& surface) {
  constexpr int kSample = 1000;
  const int step = 1 + surface.elementCount() / kSample;
  const std::vector<Ball> balls = ballsAbout(surface);
  int thin = 0, seen = 0;
  for (int e = 0; e < surface.elementCount(); e += step, ++seen) thin += isThin(balls, e) ? 1 : 0;
  return seen > 0 ? static_cast<double>(thin) / seen : 0;
}

std::vector<bool> averagedNodes(const QuadraticSurface& surface, const TractionSlots& slots,
                                const DegreesOfFreedom& dofs) {
  std::vector<bool> isAveraged(static_cast<std::size_t>(surface.coefficientCount()), true);
  for (const int slot : dofs.extraSlots()) isAveraged[slots.slots[slot].node] = false;
  return isAveraged;
}

WeightedEquations quadraticEquations(const QuadraticSurface& surface, const BoundaryMesh& mesh,
                                     const TractionSlots& slots, const DegreesOfFreedom& dofs) {
  const std::vector<int>& extraSlots = dofs.extraSlots();
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
    if (isOnSupportBorder(surface, node))
      points.push_back(besideBorder(surface, node, isExtra));
    else if (hasExtra && own >= 0)
      points.push_back(insideFace(own));
    else
      points.push_back(surface.collocationAt(node));
  }
  for (const int slot : extraSlots) points.push_back(insideFace(slot));
  return averaged(surface, std::move(points), averagedNodes(surface, slots, dofs));
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
