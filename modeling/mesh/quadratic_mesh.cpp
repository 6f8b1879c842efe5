#include "modeling/mesh/quadratic_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>

#include "base/support_border.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/border_slide.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/node_place.h"
#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Edge of a mesh with the triangles on both sides, and the borders that it lies on.
struct MeshEdge {
  int from = -1, to = -1;     ///< nodes; counter-clockwise in `left`
  int left = -1, right = -1;  ///< triangles
  double share = 0.5;         ///< of the middle node, from `from` to `to`
  std::vector<const RegionBorder*> borders;
};

struct Middle {
  Vector3d position;
  SurfaceParameter parameter{};
};

double shareOf(const std::vector<bool>& isBorderVertex, int from, int to) {
  if (isBorderVertex[from] == isBorderVertex[to]) return 0.5;
  return isBorderVertex[from] ? kBorderEdgeShare : 1 - kBorderEdgeShare;
}

Vector3d straight(const SurfaceMesh& mesh, const MeshEdge& edge) {
  return (1 - edge.share) * mesh.positions[edge.from] + edge.share * mesh.positions[edge.to];
}

std::map<std::pair<int, int>, MeshEdge> edgesOf(const SurfaceMesh& mesh,
                                                const std::vector<bool>& isBorderVertex) {
  std::map<std::pair<int, int>, MeshEdge> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      MeshEdge& edge = edges[std::minmax(from, to)];
      if (edge.left < 0)
        edge = {from, to, static_cast<int>(t), -1, shareOf(isBorderVertex, from, to), {}};
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

double diagonal(const SurfaceMesh& mesh) {
  Vector3d low = mesh.positions.front(), high = low;
  for (const Vector3d& x : mesh.positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

/// Middle nodes on the patches of a solid.
class OnSolid {
 public:
  OnSolid(const SurfaceMesh& mesh, const Solid& solid)
      : mesh_(mesh), solid_(solid), surface_(solid), tolerance_(kConverged * diagonal(mesh)) {}

  Middle middleOf(const MeshEdge& edge) const {
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
class OnMeshBody {
 public:
  OnMeshBody(const SurfaceMesh& mesh, const MeshBody& body)
      : mesh_(mesh),
        nearest_(trianglesOf(body)),
        borders_(bordersOf(body)),
        sharp_(sharpEdgesOf(body)),
        tolerance_(kOnBorder * diagonal(mesh)) {}

  Middle middleOf(const MeshEdge& edge) const {
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
  static std::vector<std::array<Vector3d, 3>> trianglesOf(const MeshBody& body) {
    std::vector<std::array<Vector3d, 3>> triangles;
    for (const auto& t : body.triangles())
      triangles.push_back({body.positions()[t[0]], body.positions()[t[1]], body.positions()[t[2]]});
    return triangles;
  }

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
  Vector3d onBodyOf(const MeshEdge& edge, const Vector3d& x) const {
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
  Vector3d near(const MeshEdge& edge, const Vector3d& x, const Vector3d& found) const {
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

/// True if the area vector of a six-node triangle at a node, or of a quarter, points far from the
/// one in the middle or is much smaller.
bool isFolded(const std::array<Vector3d, 6>& x) {
  constexpr double kLeast = 0.2;
  const auto areaAt = [&x](double u, double v) {
    const double w = 1 - u - v;
    const Vector3d du =
        (1 - 4 * w) * x[0] + (4 * u - 1) * x[1] + 4 * (w - u) * x[3] + 4 * v * (x[4] - x[5]);
    const Vector3d dv =
        (1 - 4 * w) * x[0] + (4 * v - 1) * x[2] + 4 * u * (x[4] - x[3]) + 4 * (w - v) * x[5];
    return Vector3d(du.cross(dv));
  };
  const Vector3d middle = areaAt(1.0 / 3, 1.0 / 3);
  const auto isFar = [&](const Vector3d& area) {
    return !(area.dot(middle) > kLeast * middle.squaredNorm());
  };
  constexpr double kNodes[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  for (const auto& [u, v] : kNodes)
    if (isFar(areaAt(u, v))) return true;
  constexpr int kQuarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  return std::any_of(std::begin(kQuarters), std::end(kQuarters), [&](const int(&q)[3]) {
    return isFar(4 * (x[q[1]] - x[q[0]]).cross(x[q[2]] - x[q[0]]));
  });
}

/// The middle of the quadratic curve through the nodes of an edge.
Vector3d curveMiddle(const Vector3d& from, const Vector3d& node, const Vector3d& to, double share) {
  if (share == 0.5) return node;
  const double a = share, weight = 1 / (4 * a * (1 - a));
  return (2 * a - 1) / (4 * a) * from + weight * node + (1 - 2 * a) / (4 * (1 - a)) * to;
}

std::vector<std::array<int, 3>> quartersOf(const std::vector<std::array<int, 6>>& elements) {
  std::vector<std::array<int, 3>> quarters;
  for (const auto& [a, b, c, ab, bc, ca] : elements)
    for (const auto& quarter : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                                std::array{ab, bc, ca}})
      quarters.push_back(quarter);
  return quarters;
}

template <class OnBody>
SurfaceMesh withMiddles(const SurfaceMesh& corners, const std::vector<bool>& isBorderVertex,
                        const OnBody& onBody) {
  SurfaceMesh mesh = corners;
  const auto edges = edgesOf(corners, isBorderVertex);
  std::map<std::pair<int, int>, int> nodeOf;
  for (const auto& [nodes, edge] : edges) {
    nodeOf[nodes] = static_cast<int>(mesh.positions.size());
    const Middle middle = onBody.middleOf(edge);
    mesh.positions.push_back(middle.position);
    if (!corners.parameters.empty()) mesh.parameters.push_back(middle.parameter);
  }
  const auto shareIn = [&](const std::array<int, 6>& element, int k) {
    return shareOf(isBorderVertex, element[k], element[(k + 1) % 3]);
  };
  std::vector<std::array<int, 6>> elements;
  for (const auto& t : corners.triangles) {
    std::array<int, 6>& element = elements.emplace_back();
    for (int k = 0; k < 3; ++k) {
      element[k] = t[k];
      element[3 + k] = nodeOf.at(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  // Straightens the edges of an element; returns whether that changed one.
  const auto straighten = [&](const std::array<int, 6>& element) {
    bool hasChanged = false;
    for (int k = 0; k < 3; ++k) {
      // From the smaller index, to the same bits in both elements of the edge.
      const bool isUp = element[k] < element[(k + 1) % 3];
      const int from = element[isUp ? k : (k + 1) % 3], to = element[isUp ? (k + 1) % 3 : k];
      const double share = shareOf(isBorderVertex, from, to);
      const Vector3d onEdge = (1 - share) * mesh.positions[from] + share * mesh.positions[to];
      Vector3d& node = mesh.positions[element[3 + k]];
      hasChanged = hasChanged || onEdge != node;
      node = onEdge;
    }
    return hasChanged;
  };
  // Straight edges of one element may fold another: until nothing changes.
  for (bool hasChanged = true; hasChanged;) {
    hasChanged = false;
    for (const auto& element : elements) {
      std::array<Vector3d, 6> x;
      for (int k = 0; k < 3; ++k) x[k] = mesh.positions[element[k]];
      for (int k = 0; k < 3; ++k)
        x[3 + k] =
            curveMiddle(x[k], mesh.positions[element[3 + k]], x[(k + 1) % 3], shareIn(element, k));
      if (isFolded(x) && straighten(element)) hasChanged = true;
    }
    // Curved elements may also cut through others, as flat ones do not.
    if (!hasChanged && corners.parameters.empty())
      for (const TriangleCrossing& crossing :
           triangleCrossings(mesh.positions, quartersOf(elements)))
        for (const int t : {crossing.a, crossing.b})
          if (straighten(elements[t / 4])) hasChanged = true;
  }
  const auto fourTimes = [](const auto& list) {
    std::decay_t<decltype(list)> result;
    for (const auto& value : list) result.insert(result.end(), 4, value);
    return result;
  };
  mesh.isQuadratic = true;
  mesh.triangles = quartersOf(elements);
  mesh.patchOfTriangle = fourTimes(corners.patchOfTriangle);
  mesh.smoothingGroupOfTriangle = fourTimes(corners.smoothingGroupOfTriangle);
  mesh.bordersOfTriangle = fourTimes(corners.bordersOfTriangle);
  for (std::vector<int>& region : mesh.trianglesOfRegion) {
    std::vector<int> quarters;
    for (const int t : region)
      for (int q = 0; q < 4; ++q) quarters.push_back(4 * t + q);
    region = std::move(quarters);
  }
  return mesh;
}

}  // namespace

SurfaceMesh quadraticMesh(const SurfaceMesh& corners, const Body& body,
                          const std::vector<bool>& isSupported) {
  const auto vertexCount = static_cast<int>(corners.positions.size());
  const std::vector<bool> isBorderVertex =
      isSupported.empty() ? std::vector<bool>(corners.positions.size(), false)
                          : supportBorderVertices(corners.triangles, isSupported, vertexCount);
  if (const auto* solid = std::get_if<Solid>(&body))
    return withMiddles(corners, isBorderVertex, OnSolid(corners, *solid));
  return withMiddles(corners, isBorderVertex, OnMeshBody(corners, std::get<MeshBody>(body)));
}

}  // namespace palpa::modeling
