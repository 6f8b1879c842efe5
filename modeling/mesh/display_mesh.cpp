#include "modeling/mesh/display_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <unordered_map>

#include "modeling/mesh/node_place.h"
#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kMaxPieces = 8;
constexpr std::size_t kCheckpoint = 500;  // triangles or edges between checks of the stop token

/// Surface under the boundary mesh: points on edges and in triangles, and normals.
class Shape {
 public:
  virtual ~Shape() = default;

  struct Point {
    Vector3d position;
    std::vector<SurfaceParameter> at;  ///< in each of its patches; empty without a spline surface
  };

  /// The point at the fraction s of the edge from a to b; `left` and `right` are its triangles.
  virtual Point onEdge(int a, int b, double s, int left, int right) const = 0;
  virtual Point inTriangle(int triangle, const Vector3d& weights) const = 0;
  virtual Point atNode(int node) const = 0;
  /// Unit normal at a point, continuous within the smoothing group of the triangle.
  virtual Vector3d normal(const Point& point, int triangle, const Vector3d& weights) const = 0;
};

class FlatShape : public Shape {
 public:
  explicit FlatShape(const SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& n = mesh.triangles[t];
      const auto& x = mesh.positions;
      const Vector3d unit = (x[n[1]] - x[n[0]]).cross(x[n[2]] - x[n[0]]).normalized();
      for (int k = 0; k < 3; ++k) {
        // Weighted by angle, so that the normal does not depend on the triangulation.
        const double angle = std::acos(cornerCosine(x[n[k]], x[n[(k + 1) % 3]], x[n[(k + 2) % 3]]));
        Vector3d& sum =
            normals_.try_emplace({n[k], mesh.smoothingGroupOfTriangle[t]}, Vector3d::Zero())
                .first->second;
        sum += angle * unit;
      }
    }
    for (auto& [key, sum] : normals_) sum.normalize();
  }

  Point onEdge(int a, int b, double s, int, int) const override {
    return {mesh_.positions[a] + s * (mesh_.positions[b] - mesh_.positions[a]), {}};
  }
  Point inTriangle(int triangle, const Vector3d& w) const override {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {w[0] * mesh_.positions[a] + w[1] * mesh_.positions[b] + w[2] * mesh_.positions[c], {}};
  }
  Point atNode(int node) const override { return {mesh_.positions[node], {}}; }
  Vector3d normal(const Point&, int triangle, const Vector3d& weights) const override {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      sum += weights[k] *
             normals_.at({mesh_.triangles[triangle][k], mesh_.smoothingGroupOfTriangle[triangle]});
    return sum.normalized();
  }

 private:
  const SurfaceMesh& mesh_;
  std::map<std::pair<int, int>, Vector3d> normals_;  // per node and smoothing group
};

class SplineShape : public Shape {
 public:
  SplineShape(const SurfaceMesh& mesh, const Solid& solid)
      : mesh_(mesh), solid_(solid), surface_(solid), groupOfPatch_(solid.patches().size(), -1) {
    for (const SurfaceParameter& at : mesh.parameters)
      places_.push_back(placeOf(solid, surface_, at));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      groupOfPatch_[mesh.patchOfTriangle[t]] = mesh.smoothingGroupOfTriangle[t];
  }

  Point onEdge(int a, int b, double s, int left, int right) const override {
    const int patch = mesh_.patchOfTriangle[left];
    if (patch != mesh_.patchOfTriangle[right])
      if (const auto point = onCommonEdge(a, b, s, patch, mesh_.patchOfTriangle[right]))
        return *point;
    const std::array<SurfaceParameter, 3> corners = cornersOf(left);
    const auto name = [&](int node) {
      const auto& n = mesh_.triangles[left];
      return corners[std::find(n.begin(), n.end(), node) - n.begin()];
    };
    const SurfaceParameter p = name(a);
    const SurfaceParameter q = name(b);
    return named({patch, p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
  }

  Point inTriangle(int triangle, const Vector3d& w) const override {
    const auto [a, b, c] = cornersOf(triangle);
    return named({mesh_.patchOfTriangle[triangle], w[0] * a.u + w[1] * b.u + w[2] * c.u,
                  w[0] * a.v + w[1] * b.v + w[2] * c.v});
  }

  Point atNode(int node) const override { return {mesh_.positions[node], places_[node].at}; }

  Vector3d normal(const Point& point, int triangle, const Vector3d&) const override {
    const int group = mesh_.smoothingGroupOfTriangle[triangle];
    Vector3d sum = Vector3d::Zero();
    for (const SurfaceParameter& at : point.at)
      if (groupOfPatch_[at.patch] == group) sum += surface_.normal(at.patch, at.u, at.v);
    // A mesh edge beside the common edge of two patches has parameters in one patch only.
    if (sum.squaredNorm() == 0.0 && !point.at.empty())
      sum = surface_.normal(point.at[0].patch, point.at[0].u, point.at[0].v);
    return sum.normalized();
  }

 private:
  Point named(const SurfaceParameter& at) const {
    return {surface_.position(at.patch, at.u, at.v), {at}};
  }

  std::array<SurfaceParameter, 3> cornersOf(int triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return cornersIn(surface_, mesh_.patchOfTriangle[triangle],
                     {&places_[a], &places_[b], &places_[c]});
  }

  std::optional<Point> onCommonEdge(int a, int b, double s, int left, int right) const {
    for (Side side : kSides) {
      const int index = solid_.edgeOf(left, side);
      const SolidEdge& edge = solid_.edges()[index];
      if (edge.uses[0].patch + edge.uses[1].patch != left + right ||
          (edge.uses[0].patch != left && edge.uses[1].patch != left))
        continue;
      const auto first = fractionOn(index, a);
      const auto second = fractionOn(index, b);
      if (!first || !second) continue;
      const double t = *first + s * (*second - *first);
      const SurfaceParameter p = modeling::onEdge(surface_, edge, 0, t);
      return Point{surface_.position(p.patch, p.u, p.v),
                   {p, modeling::onEdge(surface_, edge, 1, t)}};
    }
    return std::nullopt;
  }

  std::optional<double> fractionOn(int edge, int node) const {
    const NodePlace& place = places_[node];
    if (place.edge == edge) return place.edgeFraction;
    const auto& ends = solid_.edges()[edge].vertices;
    if (place.vertex >= 0 && place.vertex == ends[0]) return 0.0;
    if (place.vertex >= 0 && place.vertex == ends[1]) return 1.0;
    return std::nullopt;
  }

  const SurfaceMesh& mesh_;
  const Solid& solid_;
  SurfaceEvaluator surface_;
  std::vector<NodePlace> places_;
  std::vector<int> groupOfPatch_;
};

class Subdivision {
 public:
  Subdivision(const SurfaceMesh& mesh, const Shape& shape, const DisplaySettings& settings,
              const Job& job)
      : mesh_(mesh), shape_(shape), settings_(settings), job_(job) {}

  DisplayMesh run() {
    gatherEdges();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (t % kCheckpoint == 0) job_.throwIfCancelled();
      cut(static_cast<int>(t));
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) addLine(edges_[e]);
    return std::move(result_);
  }

 private:
  struct Edge {
    int a, b;  ///< a < b
    int left = -1, right = -1;
    std::vector<Shape::Point> inner;  ///< between a and b
    /// Vertices from a to b, ends included, for the smoothing groups of `left` and of `right`.
    std::array<std::vector<int>, 2> vertices;
  };

  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
           static_cast<std::uint32_t>(std::max(a, b));
  }

  void gatherEdges() {
    edgeOf_.reserve(3 * mesh_.triangles.size() / 2);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int a = mesh_.triangles[t][k];
        const int b = mesh_.triangles[t][(k + 1) % 3];
        const auto [entry, isNew] = edgeOf_.emplace(key(a, b), static_cast<int>(edges_.size()));
        if (isNew) edges_.push_back({std::min(a, b), std::max(a, b), -1, -1, {}, {}});
        (a < b ? edges_[entry->second].left : edges_[entry->second].right) = static_cast<int>(t);
      }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (e % kCheckpoint == 0) job_.throwIfCancelled();
      Edge& edge = edges_[e];
      if (edge.left < 0 || edge.right < 0)
        throw std::invalid_argument("displayMesh: the boundary mesh is not closed");
      const int count = pieces(edge);
      for (int i = 1; i < count; ++i)
        edge.inner.push_back(
            shape_.onEdge(edge.a, edge.b, static_cast<double>(i) / count, edge.left, edge.right));
    }
  }

  /// A chord of length l with its middle f off the arc turns by about 8 f / l.
  int pieces(const Edge& edge) const {
    if (settings_.leastPieces == settings_.mostPieces) return settings_.leastPieces;
    const Vector3d& p = mesh_.positions[edge.a];
    const Vector3d& q = mesh_.positions[edge.b];
    const Vector3d middle = shape_.onEdge(edge.a, edge.b, 0.5, edge.left, edge.right).position;
    const double turn = 8.0 * (middle - 0.5 * (p + q)).norm() / (q - p).norm();
    const double count = std::ceil(turn / settings_.pieceAngle - 1e-9);
    if (!(count > settings_.leastPieces)) return settings_.leastPieces;
    return static_cast<int>(std::min<double>(count, settings_.mostPieces));
  }

  int add(const Shape::Point& point, int triangle, const Vector3d& weights) {
    result_.positions.push_back(point.position);
    result_.normals.push_back(shape_.normal(point, triangle, weights));
    result_.links.push_back({triangle, weights});
    return static_cast<int>(result_.positions.size()) - 1;
  }

  int nodeVertex(int triangle, int corner) {
    const int node = mesh_.triangles[triangle][corner];
    const auto [entry, isNew] =
        nodeVertices_.emplace(std::pair(node, mesh_.smoothingGroupOfTriangle[triangle]), -1);
    if (isNew) entry->second = add(shape_.atNode(node), triangle, Vector3d::Unit(corner));
    return entry->second;
  }

  /// Vertices along the side of a triangle from its corner k to the next.
  std::vector<int> sideVertices(int triangle, int k) {
    const int from = mesh_.triangles[triangle][k];
    const int to = mesh_.triangles[triangle][(k + 1) % 3];
    Edge& edge = edges_[edgeOf_.at(key(from, to))];
    const bool forward = from == edge.a;
    const int other = forward ? edge.right : edge.left;
    const bool isShared =
        mesh_.smoothingGroupOfTriangle[other] == mesh_.smoothingGroupOfTriangle[triangle];
    std::vector<int>& line = edge.vertices[isShared || forward ? 0 : 1];
    if (line.empty()) {
      const int count = static_cast<int>(edge.inner.size()) + 1;
      const int atA = forward ? k : (k + 1) % 3;
      const int atB = forward ? (k + 1) % 3 : k;
      line.push_back(nodeVertex(triangle, atA));
      for (int i = 1; i < count; ++i) {
        const double s = static_cast<double>(i) / count;
        Vector3d weights = Vector3d::Zero();
        weights[atA] = 1.0 - s;
        weights[atB] = s;
        line.push_back(add(edge.inner[i - 1], triangle, weights));
      }
      line.push_back(nodeVertex(triangle, atB));
    }
    return forward ? line : std::vector<int>(line.rbegin(), line.rend());
  }

  /// Cuts a triangle into a lattice with n pieces per side, where n is the largest number of pieces
  /// of its sides. On sides with fewer pieces several lattice points are merged, towards the nearer
  /// end, and triangles that lose a side are omitted. No other triangle is inverted or flattened.
  void cut(int t) {
    const std::array<std::vector<int>, 3> sides{sideVertices(t, 0), sideVertices(t, 1),
                                                sideVertices(t, 2)};
    const int n =
        static_cast<int>(std::max({sides[0].size(), sides[1].size(), sides[2].size()})) - 1;
    const auto onSide = [&](int side, int i) {
      const int count = static_cast<int>(sides[side].size()) - 1;
      const auto towardsStart = [&](int j) { return (2 * j * count + n - 1) / (2 * n); };
      return sides[side][2 * i <= n ? towardsStart(i) : count - towardsStart(n - i)];
    };
    std::vector<std::vector<int>> grid(n + 1);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        // Weight i belongs to corner 1, j to corner 2.
        if (j == 0)
          grid[i].push_back(onSide(0, i));
        else if (i + j == n)
          grid[i].push_back(onSide(1, j));
        else if (i == 0)
          grid[i].push_back(onSide(2, n - j));
        else {
          const Vector3d weights = Vector3d(n - i - j, i, j) / n;
          grid[i].push_back(add(shape_.inTriangle(t, weights), t, weights));
        }
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        addTriangle(t, {grid[i][j], grid[i + 1][j], grid[i][j + 1]});
        if (i + j + 1 < n) addTriangle(t, {grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
      }
  }

  void addTriangle(int t, const std::array<int, 3>& v) {
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
    result_.triangles.push_back(v);
    result_.boundaryTriangle.push_back(t);
    result_.patchOfTriangle.push_back(mesh_.patchOfTriangle[t]);
  }

  void addLine(const Edge& edge) {
    const std::vector<int>& line = edge.vertices[0];
    for (std::size_t i = 1; i < line.size(); ++i)
      result_.edgeLines.push_back({line[i - 1], line[i]});
  }

  const SurfaceMesh& mesh_;
  const Shape& shape_;
  const DisplaySettings& settings_;
  const Job& job_;
  std::vector<Edge> edges_;
  std::unordered_map<std::uint64_t, int> edgeOf_;
  std::map<std::pair<int, int>, int> nodeVertices_;  // (node, smoothing group) -> vertex
  DisplayMesh result_;
};

}  // namespace

void DisplaySettings::validate() const {
  if (leastPieces < 1 || leastPieces > kMaxPieces)
    throw std::invalid_argument("DisplaySettings: leastPieces must be in 1 … 8");
  if (mostPieces < leastPieces || mostPieces > kMaxPieces)
    throw std::invalid_argument("DisplaySettings: mostPieces must be in leastPieces … 8");
  if (!(pieceAngle > 0.0))
    throw std::invalid_argument("DisplaySettings: pieceAngle must be greater than 0");
}

DisplayMesh displayMesh(const SurfaceMesh& mesh, const Body& body, const DisplaySettings& settings,
                        const Job& job) {
  settings.validate();
  job.throwIfCancelled();
  const auto* solid = std::get_if<Solid>(&body);
  if (solid && !mesh.parameters.empty())
    return Subdivision(mesh, SplineShape(mesh, *solid), settings, job).run();
  return Subdivision(mesh, FlatShape(mesh), settings, job).run();
}

}  // namespace palpa::modeling
