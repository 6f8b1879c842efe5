#include "modeling/mesh/structured_mesh.h"

#include <map>

#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {
namespace {

constexpr int kRowCheck = 1000;  // nodes between checks of the stop token

class Builder {
 public:
  Builder(const Solid& solid, const SurfaceEvaluator& surface, const Counts& counts,
          const std::vector<double>& edgeLengths, const Job& job)
      : counts_(counts), edgeLengths_(edgeLengths), job_(job) {
    mesh_.solid = &solid;
    mesh_.surface = &surface;
  }

  WorkMesh build() {
    addCornersAndEdges();
    for (std::size_t p = 0; p < counts_.size(); ++p) addPatch(static_cast<int>(p));
    return std::move(mesh_);
  }

 private:
  int add(WorkNode node) {
    mesh_.nodes.push_back(std::move(node));
    return static_cast<int>(mesh_.nodes.size()) - 1;
  }

  int pieces(int patch, int direction) const { return static_cast<int>(counts_[patch][direction]); }

  void addCornersAndEdges() {
    for (const SolidEdge& edge : mesh_.solid->edges()) {
      job_.throwIfCancelled();
      for (int vertex : edge.vertices)
        if (!corners_.contains(vertex)) corners_[vertex] = add(mesh_.nodeInCorner(vertex));
      const PatchEdge use = edge.uses[0];
      const int direction = directionOf(use.side);
      const SurfaceParameter start = onSide(*mesh_.surface, use, 0.0);
      const IsoCurve curve(*mesh_.surface, use.patch, direction,
                           direction == 0 ? start.v : start.u);
      const double length =
          std::min(edgeLengths_[edge.uses[0].patch], edgeLengths_[edge.uses[1].patch]);
      const std::vector<double> fractions = curve.cut(pieces(use.patch, direction), length);
      std::vector<int> line{corners_[edge.vertices[0]]};
      for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
        line.push_back(add(mesh_.nodeOnEdge(static_cast<int>(edges_.size()), fractions[i])));
      line.push_back(corners_[edge.vertices[1]]);
      edges_.push_back(std::move(line));
    }
  }

  /// Nodes along a side, in the order of its parameter.
  std::vector<int> sideNodes(int patch, Side side) const {
    const int index = mesh_.solid->edgeOf(patch, side);
    const SolidEdge& edge = mesh_.solid->edges()[index];
    std::vector<int> line = edges_[index];
    const bool first = edge.uses[0].patch == patch && edge.uses[0].side == side;
    if (!first && edge.reversed) std::reverse(line.begin(), line.end());
    return line;
  }

  void addPatch(int patch) {
    const int m = pieces(patch, 0);
    const int n = pieces(patch, 1);
    std::vector<std::vector<int>> grid(m + 1, std::vector<int>(n + 1));
    const std::vector<int> bottom = sideNodes(patch, Side::kVMin);
    const std::vector<int> top = sideNodes(patch, Side::kVMax);
    const std::vector<int> left = sideNodes(patch, Side::kUMin);
    const std::vector<int> right = sideNodes(patch, Side::kUMax);
    for (int i = 0; i <= m; ++i) {
      grid[i][0] = bottom[i];
      grid[i][n] = top[i];
    }
    for (int j = 0; j <= n; ++j) {
      grid[0][j] = left[j];
      grid[m][j] = right[j];
    }
    const auto [uLow, uHigh] = mesh_.surface->range(patch, 0);
    const auto [vLow, vHigh] = mesh_.surface->range(patch, 1);
    const auto uPart = [&, low = uLow, size = uHigh - uLow](int node) {
      return (mesh_.in(node, patch).u - low) / size;
    };
    const auto vPart = [&, low = vLow, size = vHigh - vLow](int node) {
      return (mesh_.in(node, patch).v - low) / size;
    };
    for (int i = 1; i < m; ++i) {
      for (int j = 1; j < n; ++j) {
        if (j % kRowCheck == 1) job_.throwIfCancelled();
        // The crossing of the line bottom[i]–top[i] with the line left[j]–right[j] in the unit
        // square: u = u0 + v du, v = v0 + u dv.
        const double u0 = uPart(bottom[i]);
        const double du = uPart(top[i]) - u0;
        const double v0 = vPart(left[j]);
        const double dv = vPart(right[j]) - v0;
        const double u = (u0 + v0 * du) / (1.0 - du * dv);
        const double v = v0 + u * dv;
        grid[i][j] =
            add(mesh_.nodeInPatch({patch, uLow + u * (uHigh - uLow), vLow + v * (vHigh - vLow)}));
      }
    }
    for (int i = 0; i < m; ++i) {
      job_.throwIfCancelled();
      for (int j = 0; j < n; ++j)
        addCell(patch, {grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
    }
  }

  /// Splits a cell (corners counter-clockwise) along the diagonal with the larger smallest angle.
  /// On a tie within rounding the first diagonal is used, so that symmetric cells are split alike.
  void addCell(int patch, const std::array<int, 4>& cell) {
    const auto angle = [&](int a, int b, int c) {
      return smallestAngle(mesh_.nodes[cell[a]].position, mesh_.nodes[cell[b]].position,
                           mesh_.nodes[cell[c]].position);
    };
    const double first = std::min(angle(0, 1, 2), angle(0, 2, 3));
    const double second = std::min(angle(0, 1, 3), angle(1, 2, 3));
    if (second > first + 1e-9) {
      mesh_.triangles.push_back({{cell[0], cell[1], cell[3]}, patch, 0});
      mesh_.triangles.push_back({{cell[1], cell[2], cell[3]}, patch, 0});
    } else {
      mesh_.triangles.push_back({{cell[0], cell[1], cell[2]}, patch, 0});
      mesh_.triangles.push_back({{cell[0], cell[2], cell[3]}, patch, 0});
    }
  }

  const Counts& counts_;
  const std::vector<double>& edgeLengths_;
  const Job& job_;
  WorkMesh mesh_;
  std::map<int, int> corners_;           // solid vertex -> node
  std::vector<std::vector<int>> edges_;  // nodes along each solid edge
};

}  // namespace

WorkMesh structuredMesh(const Solid& solid, const SurfaceEvaluator& surface, const Counts& counts,
                        const std::vector<double>& edgeLengths, const Job& job) {
  return Builder(solid, surface, counts, edgeLengths, job).build();
}

}  // namespace palpa::modeling
