#include "modeling/mesh/mesh_refine.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace palpa::modeling {
namespace {

/// A triangle is small enough if its longest edge is below this multiple of the wanted size: a
/// square cell of the wanted size must keep its diagonal, with a margin for distortion.
constexpr double kDiagonal = 1.6;

constexpr std::size_t kCheckpoint = 1000;  // nodes or triangles between checks of the stop token

struct DirectedEdge {
  int a;
  int b;
  double length;
};

DirectedEdge longestEdge(const MeshEditor& editor, int triangle) {
  const auto& n = editor.mesh().triangles[triangle].nodes;
  DirectedEdge longest{n[0], n[1], 0.0};
  for (int k = 0; k < 3; ++k) {
    const int a = n[k];
    const int b = n[(k + 1) % 3];
    const double length = (editor.position(a) - editor.position(b)).norm();
    // Rounding must not decide between equal edges, otherwise bisection paths would not end.
    if (length > longest.length * (1.0 + 1e-9)) longest = {a, b, length};
  }
  return longest;
}

/// Length of the shortest path along mesh edges from the source edges to each node (Dijkstra).
std::vector<double> distances(const MeshEditor& editor,
                              const std::function<bool(int, int)>& isSource) {
  const auto count = editor.mesh().nodes.size();
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kCheckpoint == 0) editor.checkpoint();
    const int node = static_cast<int>(i);
    if (editor.around(node).empty()) continue;
    for (int other : editor.neighbours(node))
      if (isSource(node, other)) {
        distance[i] = 0.0;
        queue.emplace(0.0, node);
        break;
      }
  }
  for (std::size_t visited = 0; !queue.empty(); ++visited) {
    if (visited % kCheckpoint == 0) editor.checkpoint();
    const auto [d, node] = queue.top();
    queue.pop();
    if (d > distance[node]) continue;
    for (int other : editor.neighbours(node)) {
      const double length = d + (editor.position(node) - editor.position(other)).norm();
      if (length >= distance[other]) continue;
      distance[other] = length;
      queue.emplace(length, other);
    }
  }
  return distance;
}

}  // namespace

void bisect(MeshEditor& editor, int triangle) {
  // On a nearly folded surface the longest edges may lead away from the triangle again and again.
  constexpr int kMaxSplits = 200;
  const std::array<int, 3> nodes = editor.mesh().triangles[triangle].nodes;
  for (int k = 0; k < kMaxSplits && editor.mesh().triangles[triangle].nodes == nodes; ++k) {
    DirectedEdge edge = longestEdge(editor, triangle);
    for (;;) {
      const DirectedEdge next = longestEdge(editor, editor.leftOf(edge.b, edge.a));
      if (next.length <= edge.length * (1.0 + 1e-9)) break;
      edge = next;
    }
    editor.split(edge.a, edge.b);
  }
}

void refineTowards(MeshEditor& editor, const std::function<bool(int, int)>& isSource,
                   double smallest, double largest) {
  constexpr int kRounds = 40;  // each round halves an area; 6 levels need about 12
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> distance = distances(editor, isSource);
    std::vector<std::pair<int, std::array<int, 3>>> large;
    for (std::size_t i = 0; i < editor.mesh().triangles.size(); ++i) {
      if (i % kCheckpoint == 0) editor.checkpoint();
      const int t = static_cast<int>(i);
      if (!editor.isAlive(t)) continue;
      const std::array<int, 3>& nodes = editor.mesh().triangles[i].nodes;
      const double nearest = std::min({distance[nodes[0]], distance[nodes[1]], distance[nodes[2]]});
      const double size = smallest + kSizeGrowth * nearest;
      if (size < largest && longestEdge(editor, t).length > kDiagonal * size)
        large.emplace_back(t, nodes);
    }
    if (large.empty()) return;
    // Triangles that a neighbour's bisection has cut are examined again in the next round.
    for (const auto& [t, nodes] : large)
      if (editor.mesh().triangles[t].nodes == nodes) bisect(editor, t);
  }
}

void boundAspect(MeshEditor& editor, const std::set<int>& narrowPatches,
                 const std::set<int>& longPatches) {
  if (narrowPatches.empty()) return;
  const auto& triangles = editor.mesh().triangles;
  // Sides of a triangle by length, shortest first.
  const auto sorted = [&](int t) {
    std::array<DirectedEdge, 3> sides{};
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t].nodes[k];
      const int b = triangles[t].nodes[(k + 1) % 3];
      sides[k] = {a, b, (editor.position(a) - editor.position(b)).norm()};
    }
    std::stable_sort(sides.begin(), sides.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
      return x.length < y.length;
    });
    return sides;
  };
  // Where patches are curved in both directions, the diagonal of a long cell may be shorter than
  // one of its long sides, so these are known from the structured mesh.
  std::set<std::pair<int, int>> longSides;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& other = triangles[i ^ 1U].nodes;
    const auto isIn = [&](int node) {
      return std::find(other.begin(), other.end(), node) != other.end();
    };
    const std::array<DirectedEdge, 3> s = sorted(static_cast<int>(i));
    for (const int k : {2, 1})
      if (!isIn(s[k].a) || !isIn(s[k].b)) {
        longSides.insert(std::minmax(s[k].a, s[k].b));
        break;
      }
  }
  const auto isLongSide = [&](const DirectedEdge& edge) {
    return longSides.contains(std::minmax(edge.a, edge.b));
  };
  // A long cell has two triangles with one long side each and a common diagonal. Halving the sides
  // and flipping the diagonal gives two cells of half the length.
  for (int cuts = 1; cuts < kMaxCuts; cuts *= 2) {
    std::vector<DirectedEdge> sides;
    std::vector<DirectedEdge> diagonals;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (i % kCheckpoint == 0) editor.checkpoint();
      const bool isNarrow = narrowPatches.contains(triangles[i].patch);
      // Once: bisection would halve the short edges of long cells, too, again and again.
      const bool isLong = cuts == 1 && longPatches.contains(triangles[i].patch);
      if (!isNarrow && !isLong) continue;
      const std::array<DirectedEdge, 3> s = sorted(static_cast<int>(i));
      if (isNarrow && 0.5 * std::numbers::sqrt3 * s[1].length <= kMaxAspect * s[0].length) continue;
      const bool isLongest = isLongSide(s[2]) && !isLongSide(s[1]);
      sides.push_back(s[isLongest ? 2 : 1]);
      diagonals.push_back(s[isLongest ? 1 : 2]);
    }
    for (const DirectedEdge& side : sides) {
      if (editor.leftOf(side.a, side.b) < 0) continue;
      const int middle = editor.split(side.a, side.b);
      longSides.insert(std::minmax(side.a, middle));
      longSides.insert(std::minmax(middle, side.b));
    }
    for (const DirectedEdge& diagonal : diagonals)
      if (editor.leftOf(diagonal.a, diagonal.b) >= 0) editor.flip(diagonal.a, diagonal.b);
    // Neighbours are graded after each step, so that their triangles keep a good shape.
    std::vector<std::pair<int, std::array<int, 3>>> uneven;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (i % kCheckpoint == 0) editor.checkpoint();
      if (narrowPatches.contains(triangles[i].patch)) continue;
      const std::array<DirectedEdge, 3> s = sorted(static_cast<int>(i));
      if (s[2].length > kMaxUnevenness * s[0].length)
        uneven.emplace_back(static_cast<int>(i), triangles[i].nodes);
    }
    for (const auto& [t, nodes] : uneven)
      if (triangles[t].nodes == nodes) bisect(editor, t);
  }
}

}  // namespace palpa::modeling
