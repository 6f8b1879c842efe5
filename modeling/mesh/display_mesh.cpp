#include "modeling/mesh/display_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "modeling/mesh/displayed_shape.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kMaxPieces = 8;
constexpr std::size_t kCheckpoint = 500;  // triangles or edges between checks of the stop token

class Subdivision {
 public:
  Subdivision(const SurfaceMesh& mesh, const DisplayedShape& shape, const DisplaySettings& settings,
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
    std::vector<DisplayedShape::Point> inner;  ///< between a and b
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

  int add(const DisplayedShape::Point& point, int triangle, const Vector3d& weights) {
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
  const DisplayedShape& shape_;
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
  return Subdivision(mesh, *makeDisplayedShape(mesh, body), settings, job).run();
}

}  // namespace palpa::modeling
