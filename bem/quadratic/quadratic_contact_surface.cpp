#include "bem/quadratic/quadratic_contact_surface.h"

#include <algorithm>
#include <cmath>

#include "bem/base/triangle_rule.h"
#include "bem/element/foot_step.h"
#include "bem/triangle/contact_foot.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Cells per narrowest radius: the integrals of bumps have errors of about 1e-3.
constexpr double kCellsPerRadius = 2;
constexpr int kMaxCells = 16;

/// Length of the edge from a corner of an element to the next along its three nodes, mm.
double edgeLength(const QuadraticSurface& surface, int element, int edge) {
  const std::vector<int>& nodes = surface.coefficients(element);
  const Vector3d &from = surface.nodes()[nodes[edge]], &middle = surface.nodes()[nodes[3 + edge]],
                 &to = surface.nodes()[nodes[(edge + 1) % 3]];
  return (middle - from).norm() + (to - middle).norm();
}

double longestEdge(const QuadraticSurface& surface, int element) {
  return std::max({edgeLength(surface, element, 0), edgeLength(surface, element, 1),
                   edgeLength(surface, element, 2)});
}

/// Newton step from a place towards the foot of a point, in local coordinates.
Vector2d localStep(const QuadraticSurface& surface, const ElementPlace& place,
                   const Vector3d& tool) {
  const BorderCoordinates& coordinates = surface.coordinates(place.element);
  const Vector2d local(place.u, place.v);
  const SurfaceJet jet = surface.geometricJet(place.element, coordinates.geometric(local));
  const QuadraticSurface::Polynomial& c = surface.polynomial(place.element);
  const Vector2d step = stepToFoot(
      SurfaceJet2{jet.position, jet.du, jet.dv, 2 * c.col(3), c.col(4), 2 * c.col(5)}, tool);
  const Vector2d regular = coordinates.awayFromBorder(local, kMinBorderRoot);
  return coordinates.derivative(regular).inverse() * step;
}

}  // namespace

QuadraticContactElements::QuadraticContactElements(const QuadraticSurface& surface,
                                                   const std::vector<double>& narrowest) {
  const int count = surface.elementCount();
  elements_.resize(static_cast<std::size_t>(count));
  cells_.resize(static_cast<std::size_t>(count));
  cellOf_.resize(static_cast<std::size_t>(count));
  for (int e = 0; e < count; ++e) {
    Element& element = elements_[e];
    element.coefficients = surface.coefficients(e);
    element.slots = surface.slots(e);
    struct Sample {
      Vector3d position;
      double weight;
      std::array<double, 6> basis;
    };
    const double cells = std::clamp(
        std::ceil(kCellsPerRadius * longestEdge(surface, e) / narrowest[e]), 1.0, 1.0 * kMaxCells);
    std::vector<Sample> bumps;
    surface.visitPoints(
        e, static_cast<int>(cells),
        [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
          bumps.push_back({jet.position, weight, QuadraticBasis(place.u, place.v).values});
        });
    const auto points = static_cast<Index>(bumps.size());
    element.bumpPoints.resize(points, 3);
    element.bumpWeights.resize(points);
    Eigen::MatrixXd basis(points, 6);
    for (Index q = 0; q < points; ++q) {
      element.bumpPoints.row(q) = bumps[q].position.transpose();
      element.bumpWeights[q] = bumps[q].weight;
      basis.row(q) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(bumps[q].basis.data());
    }
    element.moments = basis.transpose() * element.bumpWeights.asDiagonal();
    element.mass = element.moments * basis;
    element.project = element.mass.ldlt().solve(element.moments);
    element.center = element.bumpPoints.colwise().mean().transpose();
    element.radius =
        (element.bumpPoints.rowwise() - element.center.transpose()).rowwise().norm().maxCoeff();
    cellOf_[e] = e;
    cells_[e].elements = {e};
    for (int edge = 0; edge < 3; ++edge) {
      Side& side = cells_[e].sides[edge];
      const Vector2d from(edge == 1 ? 1 : 0, edge == 2 ? 1 : 0),
          to(edge == 0 ? 1 : 0, edge == 1 ? 1 : 0);
      for (int k = 0; k <= kPieces; ++k) {
        const Vector2d at = from + (to - from) * k / kPieces;
        side.points[k] = surface.evaluate({e, at[0], at[1]}).position;
      }
      side.radius = 0;
      for (const Vector3d& point : side.points)
        side.radius = std::max(side.radius, (point - side.points[kPieces / 2]).norm());
      for (const int other : surface.around(surface.coefficients(e)[3 + edge]))
        if (other != e) side.neighbours.push_back(other);
    }
    cells_[e].sides[3] = cells_[e].sides[0];  // a triangle has three
  }
  setAround(surface.coefficientCount());
  std::vector<double> areas(static_cast<std::size_t>(surface.coefficientCount()), 0);
  for (const Element& element : elements_)
    for (const int node : element.coefficients) areas[node] += element.bumpWeights.sum();
  for (Element& element : elements_)
    for (int f = 0; f < 6; ++f)
      element.project.row(f) *= element.bumpWeights.sum() / areas[element.coefficients[f]];
}

QuadraticContactSurface::QuadraticContactSurface(const QuadraticDiscretisation& discretisation,
                                                 const DegreesOfFreedom& dofs)
    : ElementContactSurface(discretisation.mesh(), discretisation.meshSlots(),
                            discretisation.slots(), dofs),
      surface_(discretisation.surface()),
      longestAt_(static_cast<std::size_t>(surface_.coefficientCount()), 0),
      elements_(surface_, narrowestOfElements()),
      coefficientAt_(longestAt_.size(), -1) {
  for (int e = 0; e < surface_.elementCount(); ++e)
    for (const int node : surface_.coefficients(e))
      longestAt_[node] = std::max(longestAt_[node], longestEdge(surface_, e));
  for (int e = 0; e < surface_.elementCount(); ++e)
    for (int f = 0; f < 6; ++f) {
      const std::vector<int>& nodes = surface_.coefficients(e);
      int& found = coefficientAt_[nodes[f]];
      if (found >= 0 || !dofs.isFree(nodes[f])) continue;
      for (const int middle : f < 3 ? std::vector{3 + f, 3 + (f + 2) % 3} : std::vector{f})
        if (found < 0 && dofs.isFree(nodes[middle])) found = nodes[middle];
    }
}

std::vector<double> QuadraticContactSurface::narrowestOfElements() const {
  std::vector<double> narrowest;
  for (int e = 0; e < surface_.elementCount(); ++e)
    narrowest.push_back(kMinWidth * longestEdge(surface_, e));
  return narrowest;
}

SurfacePoint QuadraticContactSurface::at(int triangle, const Vector3d& weights) const {
  SurfacePoint point{triangle, weights, Vector3d::Zero(), 0.0};
  point.position = smoothPosition(point);
  return point;
}

SurfacePoint QuadraticContactSurface::foot(const Vector3d& tool, const SurfacePoint& start) const {
  SurfacePoint onMesh = start;
  onMesh.position = mesh().point(start.triangle, start.weights);
  onMesh = walkToFoot(mesh(), tree(), onMesh, narrowestMask(start), [&](const SurfacePoint& from) {
    const ElementPlace place = QuadraticSurface::place(from.triangle, from.weights);
    const auto localOf = [&](int corner) {
      const ElementPlace p = QuadraticSurface::place(from.triangle, Vector3d::Unit(corner));
      return Vector2d(p.u, p.v);
    };
    Eigen::Matrix2d edges;
    edges << localOf(1) - localOf(0), localOf(2) - localOf(0);
    return Vector2d(edges.inverse() * localStep(surface_, place, tool));
  });
  SurfacePoint found = at(onMesh.triangle, onMesh.weights);
  found.distance = (found.position - tool).norm();
  return found;
}

Vector3d QuadraticContactSurface::normal(const SurfacePoint& point) const {
  const ElementPlace place = QuadraticSurface::place(point.triangle, point.weights);
  const QuadraticBasis basis(place.u, place.v);
  Vector3d normal = Vector3d::Zero();
  for (int f = 0; f < 6; ++f)
    normal += basis.values[f] * slots().slots[surface_.slots(place.element)[f]].normal;
  return normal.normalized();
}

Vector3d QuadraticContactSurface::smoothPosition(const SurfacePoint& point) const {
  return surface_.evaluate(QuadraticSurface::place(point.triangle, point.weights)).position;
}

double QuadraticContactSurface::narrowestMask(const SurfacePoint& point) const {
  double length = 0;
  for (int corner = 0; corner < 3; ++corner)
    length += point.weights[corner] * longestAt_[mesh().triangles[point.triangle][corner]];
  return kMinWidth * length;
}

double QuadraticContactSurface::maskSpacing(const SurfacePoint& point) const {
  return narrowestMask(point) / (2 * kMinWidth);
}

}  // namespace palpa::bem
