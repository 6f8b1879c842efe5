#include "modeling/mesh/mesh_counts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {
namespace {

double meanLength(const SurfaceEvaluator& surface, int patch, int direction) {
  const auto [low, high] = surface.range(patch, 1 - direction);
  const auto length = [&](double fixed) {
    return IsoCurve(surface, patch, direction, fixed).length();
  };
  return (length(low) + 4.0 * length(0.5 * (low + high)) + length(high)) / 6.0;
}

}  // namespace

Counts subdivisionCounts(const Solid& solid, const SurfaceEvaluator& surface, double edgeLength) {
  const int patches = static_cast<int>(solid.patches().size());
  std::vector<int> chain(2 * patches);
  std::iota(chain.begin(), chain.end(), 0);
  const auto root = [&](int i) {
    while (chain[i] != i) i = chain[i] = chain[chain[i]];
    return i;
  };
  for (const SolidEdge& edge : solid.edges()) {
    const auto [a, b] = edge.uses;
    chain[root(2 * a.patch + directionOf(a.side))] = root(2 * b.patch + directionOf(b.side));
  }
  std::vector<double> count(2 * patches, 1.0);
  for (int i = 0; i < 2 * patches; ++i) {
    const double pieces = std::round(meanLength(surface, i / 2, i % 2) / edgeLength);
    count[root(i)] = std::max(count[root(i)], pieces);
  }
  Counts result(patches);
  for (int i = 0; i < 2 * patches; ++i) result[i / 2][i % 2] = count[root(i)];
  return result;
}

double structuredNodeCount(const Solid& solid, const Counts& counts) {
  double nodes = 0.0;
  for (const auto& [u, v] : counts) nodes += (u - 1.0) * (v - 1.0);
  std::set<int> vertices;
  for (const SolidEdge& edge : solid.edges()) {
    nodes += counts[edge.uses[0].patch][directionOf(edge.uses[0].side)] - 1.0;
    vertices.insert(edge.vertices.begin(), edge.vertices.end());
  }
  return nodes + static_cast<double>(vertices.size());
}

}  // namespace palpa::modeling
