#include "modeling/mesh/middle_nodes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/support_border.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/border_slide.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/node_place.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d straight(const SurfaceMesh& mesh, const ElementEdge& edge) {
  return (1 - edge.share) * mesh.positions[edge.from] + edge.share * mesh.positions[edge.to];
}

double diagonal(const SurfaceMesh& mesh) {
  Vector3d low = mesh.positions.front(), high = low;
  for (const Vector3d& x : mesh.positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

/// Middle nodes on the patches of a solid.
class OnSolid final : public MiddleNodes {
 public:
  OnSolid(const SurfaceMesh& mesh, const Solid& solid)
      : mesh_(mesh), solid_(solid), surface_(solid), tolerance_(kConverged * diagonal(mesh)) {}

  MiddleNode of(const ElementEdge& edge) const override {
    const Vector3d wanted = straight(mesh_, edge);
    const bool onLeft = mesh_.patchOfTriangle[edge.left] <= mesh_.patchOfTriangle[edge.right];
    const int triangle = onLeft ? edge.left : edge.right;
    const auto& nodes = mesh_.triangles[triangle];
    std::array<NodePlace, 3> places;
    for (int k = 0; k < 3; ++k) places[k] = placeOf(solid_, surface_, mesh_.parameters[nodes[k]]);
    const auto corners =
        cornersIn(surface_, mesh_.patchOfTriangle[triangle], {&places[0], &places[1], &places[2]});
    const auto cornerOf = [&](int node) {
      return corners[std::find(nodes.begin(), nodes.end(), node) - nodes.begin()];
    };
    const SurfaceParameter a = cornerOf(edge.from), b = cornerOf(edge.to);
    const SurfaceParameter start{a.patch, a.u + edge.share * (b.u - a.u),
                                 a.v + edge.share * (b.v - a.v)};
    const bool onSide = isOnSide(a, b);
    SurfaceParameter at = towards(wanted, start, onSide);
    if (!edge.borders.empty() && !slideOntoBorders(surface_, onSide, edge.borders, tolerance_, at))
      at = start;
    return {surface_.position(at.patch, at.u, at.v), at};
  }

 private:
  static constexpr double kConverged = 1e-11;  ///< of the diagonal

  bool isOnSide(const SurfaceParameter& a, const SurfaceParameter& b) const {
    const auto [uLow, uHigh] = surface_.range(a.patch, 0);
    const auto [vLow, vHigh] = surface_.range(a.patch, 1);
    return (a.u == b.u && (a.u == uLow || a.u == uHigh)) ||
           (a.v == b.v && (a.v == vLow || a.v == vHigh));
  }

  /// Gauss-Newton steps towards the nearest point, along the side if the point lies on one; the
  /// start if they leave the patch.
  SurfaceParameter towards(const Vector3d& wanted, const SurfaceParameter& start,
                           bool onSide) const {
    constexpr int kSteps = 8;
    const auto [uLow, uHigh] = surface_.range(start.patch, 0);
    const auto [vLow, vHigh] = surface_.range(start.patch, 1);
    const bool alongU = !onSide || start.v == vLow || start.v == vHigh, alongV = !onSide || !alongU;
    SurfaceParameter at = start;
    for (int step = 0; step < kSteps; ++step) {
      const SurfacePoint p = surface_.evaluate(at.patch, at.u, at.v);
      Eigen::Matrix<double, 3, 2> tangents;
      tangents << p.du, p.dv;
      if (!alongU) tangents.col(0).setZero();
      if (!alongV) tangents.col(1).setZero();
      Eigen::Matrix2d metric = tangents.transpose() * tangents;
      metric.diagonal().array() += 1e-12 * metric.trace();
      const Vector2d by = metric.inverse() * (tangents.transpose() * (wanted - p.position));
      if (!by.allFinite()) return start;
      if (alongU) at.u += by[0];
      if (alongV) at.v += by[1];
      if ((alongU && !(at.u > uLow && at.u < uHigh)) || (alongV && !(at.v > vLow && at.v < vHigh)))
        return start;
      if ((tangents * by).norm() < tolerance_) break;
    }
    // A far step has jumped to another part of the surface.
    const Vector3d found = surface_.position(at.patch, at.u, at.v),
                   first = surface_.position(start.patch, start.u, start.v);
    return (found - wanted).norm() <= (first - wanted).norm() ? at : start;
  }

  const SurfaceMesh& mesh_;
  const Solid& solid_;
  SurfaceEvaluator surface_;
  double tolerance_;
};

/// Middle nodes on the triangles of a mesh body.
class OnMeshBody final : public MiddleNodes {
 public:
  OnMeshBody(const SurfaceMesh& mesh, const MeshBody& body)
      : mesh_(mesh),
        nearest_(body.positions(), body.triangles()),
        borders_(bordersOf(body)),
        sharp_(sharpEdgesOf(body)),
        tolerance_(kOnBorder * diagonal(mesh)) {}

  MiddleNode of(const ElementEdge& edge) const override {
    constexpr int kSteps = 8;
    const Vector3d start = straight(mesh_, edge);
    const auto onBody = [&](const Vector3d& x) { return near(edge, x, onBodyOf(edge, x)); };
    Vector3d at = onBody(start);
    for (int step = 0; step < kSteps && !edge.borders.empty(); ++step) {
      for (const RegionBorder* border : edge.borders) {
        const Vector3d gradient = border->gradient(at);
        if (gradient.squaredNorm() > 0) at -= border->value(at) / gradient.squaredNorm() * gradient;
      }
      at = onBody(at);
    }
    return {at};
  }

 private:
  /// The body's edges between two faces, by the faces.
  static std::map<std::pair<int, int>, NearestOnSegments> bordersOf(const MeshBody& body) {
    std::map<std::pair<int, int>, std::vector<std::array<Vector3d, 2>>> segments;
    forEdges(body, [&](const Vector3d& a, const Vector3d& b, int one, int other) {
      const int face = body.faceOfTriangle()[one], next = body.faceOfTriangle()[other];
      if (face != next) segments[std::minmax(face, next)].push_back({a, b});
    });
    std::map<std::pair<int, int>, NearestOnSegments> borders;
    for (const auto& [faces, list] : segments) borders.emplace(faces, NearestOnSegments(list));
    return borders;
  }

  static NearestOnSegments sharpEdgesOf(const MeshBody& body) {
    const double cosine = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180);
    const auto normalOf = [&](int t) {
      const auto& [a, b, c] = body.triangles()[t];
      const auto& p = body.positions();
      return (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    };
    std::vector<std::array<Vector3d, 2>> segments;
    forEdges(body, [&](const Vector3d& a, const Vector3d& b, int one, int other) {
      if (normalOf(one).dot(normalOf(other)) < cosine) segments.push_back({a, b});
    });
    return NearestOnSegments(segments);
  }

  /// Calls `visit(a, b, one, other)` with the ends and the two triangles of every edge.
  template <class Visit>
  static void forEdges(const MeshBody& body, Visit visit) {
    const auto neighbours = triangleNeighbours(body.triangles());
    for (std::size_t t = 0; t < body.triangles().size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (static_cast<int>(t) < neighbours[t][k])
          visit(body.positions()[body.triangles()[t][k]],
                body.positions()[body.triangles()[t][(k + 1) % 3]], static_cast<int>(t),
                neighbours[t][k]);
  }

  /// The nearest point on the border between two faces if the edge runs along it, on the sharp
  /// edges if it is one, otherwise on the surface; x where the edge runs over features that the
  /// mesh leaves out. On surfaces it keeps the distance of its ends from the body.
  Vector3d onBodyOf(const ElementEdge& edge, const Vector3d& x) const {
    const auto border = borders_.find(
        std::minmax(mesh_.patchOfTriangle[edge.left], mesh_.patchOfTriangle[edge.right]));
    if (border != borders_.end() &&
        border->second.distance(mesh_.positions[edge.from]) < tolerance_ &&
        border->second.distance(mesh_.positions[edge.to]) < tolerance_)
      return border->second.nearest(x);
    const Vector3d &from = mesh_.positions[edge.from], &to = mesh_.positions[edge.to];
    const double near = kNearBody * (to - from).norm();
    if (mesh_.smoothingGroupOfTriangle[edge.left] != mesh_.smoothingGroupOfTriangle[edge.right])
      return sharp_.distance(from) < near && sharp_.distance(to) < near ? sharp_.nearest(x) : x;
    const Vector3d offset = (nearest_.nearest(from) - from + nearest_.nearest(to) - to) / 2;
    return offset.norm() < near ? nearest_.nearest(x) - offset : x;
  }

  /// `found`, or x where that is too far or beside the edge: where the mesh runs over a feature of
  /// the body, the middle must not jump into it.
  Vector3d near(const ElementEdge& edge, const Vector3d& x, const Vector3d& found) const {
    constexpr double kFar = 0.25, kBeside = 0.05;  // of the edge
    const Vector3d along = mesh_.positions[edge.to] - mesh_.positions[edge.from];
    const Vector3d step = found - x;
    const double length = along.norm();
    if (step.norm() > kFar * length) return x;
    return std::abs(step.dot(along)) > kBeside * length * length ? x : found;
  }

  static constexpr double kOnBorder = 1e-7;  ///< of the diagonal
  static constexpr double kNearBody = 0.03;  ///< of the edge

  const SurfaceMesh& mesh_;
  NearestOnTriangles nearest_;
  std::map<std::pair<int, int>, NearestOnSegments> borders_;
  NearestOnSegments sharp_;
  double tolerance_;
};

}  // namespace

double middleShare(const std::vector<bool>& isBorderVertex, int from, int to) {
  if (isBorderVertex[from] == isBorderVertex[to]) return 0.5;
  return isBorderVertex[from] ? kBorderEdgeShare : 1 - kBorderEdgeShare;
}

std::map<std::pair<int, int>, ElementEdge> elementEdges(const SurfaceMesh& mesh,
                                                        const std::vector<bool>& isBorderVertex) {
  std::map<std::pair<int, int>, ElementEdge> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      ElementEdge& edge = edges[std::minmax(from, to)];
      if (edge.left < 0)
        edge = {from, to, static_cast<int>(t), -1, middleShare(isBorderVertex, from, to), {}};
      else
        edge.right = static_cast<int>(t);
    }
  for (auto& [nodes, edge] : edges) {
    std::uint64_t sides = mesh.bordersOfTriangle[edge.left] ^ mesh.bordersOfTriangle[edge.right];
    for (; sides != 0; sides &= sides - 1)
      edge.borders.push_back(&mesh.borders[std::countr_zero(sides)]);
  }
  return edges;
}

std::unique_ptr<MiddleNodes> makeMiddleNodes(const SurfaceMesh& mesh, const Body& body) {
  if (const auto* solid = std::get_if<Solid>(&body)) return std::make_unique<OnSolid>(mesh, *solid);
  return std::make_unique<OnMeshBody>(mesh, std::get<MeshBody>(body));
}

}  // namespace palpa::modeling
