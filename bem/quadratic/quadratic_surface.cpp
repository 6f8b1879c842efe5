#include "bem/quadratic/quadratic_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "base/support_border.h"
#include "bem/base/error.h"
#include "bem/base/triangle_rule.h"
#include "bem/quadratic/quartered_mesh.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The point of the local triangle u, v >= 0, u + v <= 1 nearest to a point.
Vector2d intoTriangle(const Vector2d& at) {
  Vector2d inside = at.cwiseMax(0);
  if (inside.sum() <= 1) return inside;
  const double along = std::clamp((1 + at[1] - at[0]) / 2, 0.0, 1.0);
  return {1 - along, along};
}

/// The middle of a quadratic curve from a border vertex through the point at kBorderEdgeShare.
Vector3d curveMiddle(const Vector3d& border, const Vector3d& node, const Vector3d& end) {
  static_assert(kBorderEdgeShare == 0.25);
  return -0.5 * border + 4.0 / 3 * node + end / 6;
}

}  // namespace

QuadraticBasis::QuadraticBasis(double u, double v) {
  const double w = 1 - u - v;
  values = {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w};
  du = {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v};
  dv = {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)};
}

QuadraticSurface::QuadraticSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const std::vector<int>& supportTags, bool isPlain)
    : nodes_(mesh.nodes),
      around_(mesh.nodes.size()),
      isOnBorder_(mesh.nodes.size(), false),
      slotCount_(slots.count()),
      boundingSize_(mesh.boundingSize()) {
  const int count = mesh.triangleCount() / 4;
  if (mesh.triangleCount() % 4 != 0)
    throw std::invalid_argument("QuadraticSurface: elements need four triangles each");
  elements_.resize(static_cast<std::size_t>(count));
  for (int e = 0; e < count; ++e) {
    Element& element = elements_[e];
    element.nodes.assign(6, -1);
    element.slots.assign(6, -1);
    for (int q = 0; q < 4; ++q)
      for (int corner = 0; corner < 3; ++corner) {
        const int local = kQuarters[q][corner], t = 4 * e + q;
        int& node = element.nodes[local];
        if (node >= 0 && node != mesh.triangles[t][corner])
          throw std::invalid_argument("QuadraticSurface: the triangles are no quarters");
        node = mesh.triangles[t][corner];
        element.slots[local] = slots.ofCorner[t][corner];
      }
    for (const int node : element.nodes) around_[node].push_back(e);
  }
  if (!isPlain) setCoordinates(mesh, supportTags);
  for (int e = 0; e < count; ++e) {
    Element& element = elements_[e];
    const std::vector<int>& nodes = element.nodes;
    const auto at = [&](int k) -> Vector3d {
      if (k < 3) return nodes_[nodes[k]];
      const int from = nodes[k - 3], to = nodes[(k - 2) % 3];
      if (!isBorderEdge(isOnBorder_, from, to)) return nodes_[nodes[k]];
      return isOnBorder_[from] ? curveMiddle(nodes_[from], nodes_[nodes[k]], nodes_[to])
                               : curveMiddle(nodes_[to], nodes_[nodes[k]], nodes_[from]);
    };
    Polynomial& c = element.polynomial;
    c.col(0) = at(0);
    c.col(1) = -3 * at(0) - at(1) + 4 * at(3);
    c.col(2) = -3 * at(0) - at(2) + 4 * at(5);
    c.col(3) = 2 * at(0) + 2 * at(1) - 4 * at(3);
    c.col(4) = 4 * (at(0) - at(3) + at(4) - at(5));
    c.col(5) = 2 * at(0) + 2 * at(2) - 4 * at(5);
    const Vector3d middle = geometricJet(e, {1.0 / 3, 1.0 / 3}).areaVector();
    for (const Vector2d& node : kQuadraticNodes)
      if (!(geometricJet(e, node).areaVector().dot(middle) > 0))
        throw SolverError(SolverError::Kind::kBadMesh, "boundary mesh: the quadratic triangle " +
                                                           std::to_string(e) +
                                                           " is folded; choose a shorter edge");
  }
}

void QuadraticSurface::setCoordinates(const BoundaryMesh& mesh,
                                      const std::vector<int>& supportTags) {
  std::vector<std::array<int, 3>> corners;
  std::vector<int> tags, groups;
  for (int e = 0; e < elementCount(); ++e) {
    const std::vector<int>& nodes = elements_[e].nodes;
    groups.push_back(mesh.smoothingGroups[4 * static_cast<std::size_t>(e)]);
    corners.push_back({nodes[0], nodes[1], nodes[2]});
    tags.push_back(mesh.tags[4 * static_cast<std::size_t>(e)]);
  }
  const std::vector<bool> supported = areSupported(tags, supportTags);
  isOnBorder_ = supportBorderVertices(corners, supported, coefficientCount(),
                                      notchEdges(corners, nodes_, groups, supported));
  for (int e = 0; e < elementCount(); ++e) {
    Element& element = elements_[e];
    std::vector<int> onBorder;
    for (int k = 0; k < 3; ++k)
      if (isOnBorder_[element.nodes[k]]) onBorder.push_back(k);
    if (onBorder.empty()) continue;
    if (onBorder.size() == 1)
      element.coordinates = BorderCoordinates::vertex(onBorder.front());
    else
      element.coordinates = BorderCoordinates::edge(3 - onBorder[0] - onBorder[1]);
    element.hasBorderTractions = supported[e];
    for (int f = 0; f < 6; ++f) {
      const double root = element.coordinates.root(kQuadraticNodes[f]);
      element.tractionFactors[f] = root > 0 ? root : kBorderTractionRoot;
    }
  }
  // The middle nodes of the edges on the border.
  for (const Element& element : elements_)
    for (int k = 0; k < 3; ++k)
      if (isOnBorder_[element.nodes[k]] && isOnBorder_[element.nodes[(k + 1) % 3]])
        isOnBorder_[element.nodes[3 + k]] = true;
}

SurfaceJet QuadraticSurface::evaluate(const ElementPlace& place) const {
  const BorderCoordinates& coordinates = elements_[place.element].coordinates;
  const Vector2d local(place.u, place.v);
  if (coordinates.isPlain()) return geometricJet(place.element, local);
  const SurfaceJet jet = geometricJet(place.element, coordinates.geometric(local));
  const Matrix2d by = coordinates.derivative(local);
  return {jet.position, by(0, 0) * jet.du + by(1, 0) * jet.dv,
          by(0, 1) * jet.du + by(1, 1) * jet.dv};
}

Vector3d QuadraticSurface::position(const ElementPlace& place) const {
  const Polynomial& c = elements_[place.element].polynomial;
  const Vector2d at = coordinates(place.element).geometric({place.u, place.v});
  return c.col(0) + at[0] * (c.col(1) + at[0] * c.col(3) + at[1] * c.col(4)) +
         at[1] * (c.col(2) + at[1] * c.col(5));
}

SurfaceJet QuadraticSurface::geometricJet(int element, const Vector2d& geometric) const {
  const Polynomial& c = elements_[element].polynomial;
  const double u = geometric[0], v = geometric[1];
  return {c.col(0) + u * (c.col(1) + u * c.col(3) + v * c.col(4)) + v * (c.col(2) + v * c.col(5)),
          c.col(1) + 2 * u * c.col(3) + v * c.col(4), c.col(2) + u * c.col(4) + 2 * v * c.col(5)};
}

void QuadraticSurface::evaluateBasis(const ElementPlace& place, std::vector<double>& values) const {
  const QuadraticBasis basis(place.u, place.v);
  values.assign(basis.values.begin(), basis.values.end());
}

void QuadraticSurface::evaluateTractionBasis(const ElementPlace& place,
                                             std::vector<double>& values) const {
  const Element& element = elements_[place.element];
  if (!element.hasBorderTractions) return evaluateBasis(place, values);
  evaluateBasis(place, values);
  const double root = element.coordinates.root({place.u, place.v});
  for (int f = 0; f < 6; ++f) values[f] *= element.tractionFactors[f] / root;
}

std::span<const double> QuadraticSurface::tractionFactors(int element) const {
  if (!elements_[element].hasBorderTractions) return {};
  return elements_[element].tractionFactors;
}

SurfaceTangents QuadraticSurface::tangents(const ElementPlace& given) const {
  const Vector2d at = coordinates(given.element).awayFromBorder({given.u, given.v}, kMinBorderRoot);
  const ElementPlace place{given.element, at[0], at[1]};
  const SurfaceJet jet = evaluate(place);
  const QuadraticBasis basis(place.u, place.v);
  SurfaceTangents result;
  result.position = jet.position;
  result.values.assign(basis.values.begin(), basis.values.end());
  if (hasBorderTractions(place.element)) evaluateTractionBasis(place, result.tractionValues);
  result.frame.col(0) = jet.du.normalized();
  result.frame.col(2) = jet.areaVector().normalized();
  result.frame.col(1) = result.frame.col(2).cross(result.frame.col(0));
  Matrix2d metric;
  metric.col(0) = result.frame.leftCols<2>().transpose() * jet.du;
  metric.col(1) = result.frame.leftCols<2>().transpose() * jet.dv;
  const Matrix2d inverse = metric.inverse().transpose();
  result.slopes.resize(2, 6);
  for (int f = 0; f < 6; ++f) result.slopes.col(f) = inverse * Vector2d(basis.du[f], basis.dv[f]);
  return result;
}

ElementFoot QuadraticSurface::nearestOnElement(int element, const Vector3d& x) const {
  constexpr int kMaxSteps = 40, kMaxHalvings = 8;
  const auto distanceAt = [&](const Vector2d& at) {
    return (geometricJet(element, at).position - x).norm();
  };
  Vector2d at(1.0 / 3, 1.0 / 3);
  double distance = distanceAt(at);
  for (const Vector2d& node : kQuadraticNodes)
    if (const double found = distanceAt(node); found < distance) {
      distance = found;
      at = node;
    }
  for (int step = 0; step < kMaxSteps; ++step) {
    const SurfaceJet jet = geometricJet(element, at);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << jet.du, jet.dv;
    const Matrix2d metric = tangents.transpose() * tangents;
    const Vector2d slope = tangents.transpose() * (x - jet.position);
    // Gauss-Newton, then steepest descent along the border.
    Vector2d move = intoTriangle(at + metric.inverse() * slope) - at;
    if (move.dot(slope) <= 0) move = intoTriangle(at + slope / metric.trace()) - at;
    double found = distanceAt(at + move);
    for (int half = 0; half < kMaxHalvings && !(found < distance); ++half) {
      move /= 2;
      found = distanceAt(at + move);
    }
    if (!(found < distance)) break;
    at += move;
    distance = found;
    if (move.lpNorm<Eigen::Infinity>() < 1e-12) break;
  }
  const Vector2d local = coordinates(element).local(at);
  return {{element, local[0], local[1]}, distance};
}

void QuadraticSurface::samplePlaces(int element, std::vector<WeightedPlace>& places) const {
  // The middles of the quarters.
  for (const auto& quarter : kQuarters) {
    const Vector2d at =
        (kQuadraticNodes[quarter[0]] + kQuadraticNodes[quarter[1]] + kQuadraticNodes[quarter[2]]) /
        3;
    const ElementPlace place{element, at[0], at[1]};
    places.push_back({place, evaluate(place).areaVector().norm() / 8});
  }
}

void QuadraticSurface::evaluateShares(const ElementPlace& place,
                                      std::vector<double>& shares) const {
  const auto [triangle, weights] = quarter(place);
  shares.assign(6, 0);
  for (int corner = 0; corner < 3; ++corner)
    shares[kQuarters[triangle % 4][corner]] = weights[corner];
}

void QuadraticSurface::visitPoints(int element, int cells, const Visit& visit) const {
  const double size = 1.0 / cells;
  const auto visitCell = [&](double i, double j, double sign) {
    for (const TrianglePoint& q : triangleRule16()) {
      const ElementPlace place{element, (i + sign * q.barycentric[1]) * size,
                               (j + sign * q.barycentric[2]) * size};
      const SurfaceJet jet = evaluate(place);
      visit(place, jet, q.weight / 2 * size * size * jet.areaVector().norm());
    }
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; i + j < cells; ++j) {
      visitCell(i, j, 1);
      if (i + j + 1 < cells) visitCell(i + 1, j + 1, -1);
    }
}

TractionSlots withCurvedNormals(TractionSlots slots, const QuadraticSurface& surface) {
  for (TractionSlots::Slot& slot : slots.slots) slot.normal.setZero();
  for (int e = 0; e < surface.elementCount(); ++e)
    for (int k = 0; k < 6; ++k) {
      const SurfaceJet jet =
          surface.geometricJet(e, surface.coordinates(e).geometric(kQuadraticNodes[k]));
      // The angle of the element at the node: a corner's, or a straight one.
      double angle = std::numbers::pi;
      if (k < 3) {
        const Vector2d a = kQuadraticNodes[(k + 1) % 3] - kQuadraticNodes[k],
                       b = kQuadraticNodes[(k + 2) % 3] - kQuadraticNodes[k];
        const Vector3d alongA = a[0] * jet.du + a[1] * jet.dv,
                       alongB = b[0] * jet.du + b[1] * jet.dv;
        angle = std::atan2(alongA.cross(alongB).norm(), alongA.dot(alongB));
      }
      slots.slots[surface.slots(e)[k]].normal += angle * jet.areaVector().normalized();
    }
  for (TractionSlots::Slot& slot : slots.slots) slot.normal.normalize();
  return slots;
}

}  // namespace palpa::bem
