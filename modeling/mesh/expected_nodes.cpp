#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/disjoint_sets.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/mesh_body_surface.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Area per node over the squared mean edge length, measured; 0.87 for equilateral triangles.
constexpr double kAreaPerNode = 0.84;
constexpr int kMaxHalvings = 7;  // of triangles and edges, to sum up over a size that varies
constexpr double kTurn = 0.77;   // cosine: a stronger turn of a feature line is a corner
constexpr double kMaxTurn = std::numbers::pi / 4;  // of a feature line between two nodes
constexpr double kMaxPieces = 16;                  // for turns, as in the remesher

class Estimate {
 public:
  Estimate(const TaggedSurface& surface, const SizeField& sizes)
      : surface_(surface), sizes_(sizes), neighbours_(triangleNeighbours(surface.triangles)) {}

  /// Corners, nodes inside lines, and inside smooth parts. A part with n nodes on its border, the
  /// Euler characteristic c and m triangles has m / 2 - n / 2 + c nodes inside.
  double nodes() {
    findLines();
    double sum = corners_;
    for (const Line& line : lines_)
      sum += line.isClosed ? line.wholePieces() : line.wholePieces() - 1;
    for (const auto& [tag, part] : parts()) sum += std::max(0.0, part);
    return sum;
  }

 private:
  struct Line {
    double pieces = 0;  ///< by length
    double turn = 0;
    bool isClosed = true;
    double wholePieces() const {
      const double turns = std::min(turn / kMaxTurn, kMaxPieces);
      return std::max(isClosed ? 3.0 : 1.0, std::round(std::max(pieces, turns)));
    }
  };

  double length(const Vector3d& x) const { return kMeanEdge * sizes_.at(x); }

  double piecesOf(const Vector3d& a, const Vector3d& b, int halvings = kMaxHalvings) const {
    const Vector3d middle = (a + b) / 2;
    const double pieces = (b - a).norm() / length(middle);
    if (sizes_.isUniform() || halvings == 0 || pieces < 2) return pieces;
    return piecesOf(a, middle, halvings - 1) + piecesOf(middle, b, halvings - 1);
  }

  /// Half of the number of triangles.
  double nodesOf(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                 int halvings = kMaxHalvings) const {
    const double size = length((a + b + c) / 3);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (sizes_.isUniform() || halvings == 0 || longest < 2 * size)
      return 0.5 * (b - a).cross(c - a).norm() / (kAreaPerNode * size * size);
    const Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    const int next = halvings - 1;
    return nodesOf(a, ab, ca, next) + nodesOf(ab, b, bc, next) + nodesOf(ca, bc, c, next) +
           nodesOf(ab, bc, ca, next);
  }

  bool isFeature(std::size_t t, int k) const {
    return surface_.tags[t] != surface_.tags[neighbours_[t][k]];
  }

  void findLines() {
    std::vector<std::vector<int>> ends(surface_.positions.size());
    lineOf_.assign(surface_.triangles.size(), {-1, -1, -1});
    std::map<std::pair<int, int>, int> edges;
    std::vector<std::pair<int, int>> list;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        if (!isFeature(t, k)) continue;
        const int a = surface_.triangles[t][k], b = surface_.triangles[t][(k + 1) % 3];
        const auto [known, isNew] =
            edges.try_emplace(std::minmax(a, b), static_cast<int>(list.size()));
        lineOf_[t][k] = known->second;
        if (!isNew) continue;
        list.push_back(std::minmax(a, b));
        for (const int end : {a, b}) ends[end].push_back(known->second);
      }
    DisjointSets sets(list.size());
    std::vector<double> turns(surface_.positions.size(), 0);
    std::vector<bool> isCorner(surface_.positions.size(), false);
    for (std::size_t v = 0; v < ends.size(); ++v) {
      if (ends[v].empty()) continue;
      isCorner[v] = ends[v].size() != 2;
      if (!isCorner[v]) {
        const auto other = [&](int edge) {
          const auto [a, b] = list[edge];
          return surface_.positions[a == static_cast<int>(v) ? b : a];
        };
        const Vector3d in = (surface_.positions[v] - other(ends[v][0])).normalized();
        const Vector3d out = (other(ends[v][1]) - surface_.positions[v]).normalized();
        const double cosine = in.dot(out);
        isCorner[v] = cosine < kTurn;
        turns[v] = std::acos(std::clamp(cosine, -1.0, 1.0));
      }
      if (isCorner[v])
        ++corners_;
      else
        sets.join(ends[v][0], ends[v][1]);
    }
    std::vector<int> number(list.size(), -1);
    for (std::size_t e = 0; e < list.size(); ++e) {
      int& line = number[sets.rootOf(static_cast<int>(e))];
      if (line < 0) {
        line = static_cast<int>(lines_.size());
        lines_.emplace_back();
      }
      const auto [a, b] = list[e];
      lines_[line].pieces += piecesOf(surface_.positions[a], surface_.positions[b]);
      for (const int end : {a, b}) {
        lines_[line].isClosed = lines_[line].isClosed && !isCorner[end];
        if (!isCorner[end]) lines_[line].turn += turns[end] / 2;
      }
    }
    for (auto& of : lineOf_)
      for (int& edge : of)
        if (edge >= 0) edge = number[sets.rootOf(edge)];
  }

  /// Expected number of nodes inside each part with one tag.
  std::map<SurfaceTag, double> parts() const {
    struct Part {
      double nodes = 0;
      int triangles = 0, edgeSides = 0, borderSides = 0;
      std::vector<int> vertices, lines;
    };
    std::map<SurfaceTag, Part> parts;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      Part& part = parts[surface_.tags[t]];
      const auto& [a, b, c] = surface_.triangles[t];
      part.nodes += nodesOf(surface_.positions[a], surface_.positions[b], surface_.positions[c]);
      ++part.triangles;
      for (const int line : lineOf_[t]) {
        ++part.edgeSides;
        if (line < 0) continue;
        ++part.borderSides;
        part.lines.push_back(line);
      }
      part.vertices.insert(part.vertices.end(), {a, b, c});
    }
    const auto distinct = [](std::vector<int>& list) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    std::map<SurfaceTag, double> inside;
    for (auto& [tag, part] : parts) {
      distinct(part.vertices);
      distinct(part.lines);
      const int edges = (part.edgeSides + part.borderSides) / 2;
      double border = 0;
      for (const int line : part.lines) border += lines_[line].wholePieces();
      inside[tag] = part.nodes - border / 2 + static_cast<double>(part.vertices.size()) - edges +
                    part.triangles;
    }
    return inside;
  }

  const TaggedSurface& surface_;
  const SizeField& sizes_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<std::array<int, 3>> lineOf_;  // per triangle and side; -1: inside a part
  std::vector<Line> lines_;
  double corners_ = 0;
};

}  // namespace

double expectedNodes(const TaggedSurface& surface, const SizeField& sizes) {
  return Estimate(surface, sizes).nodes();
}

}  // namespace palpa::modeling
