#include "modeling/body/closed_surfaces.h"

#include <algorithm>

#include "base/disjoint_sets.h"

namespace palpa::modeling {
namespace {

int countOf(const Solid& solid) {
  DisjointSets patches(solid.patches().size());
  for (const SolidEdge& edge : solid.edges()) patches.join(edge.uses[0].patch, edge.uses[1].patch);
  return patches.count();
}

int countOf(const MeshBody& body) {
  return closedSurfaceCount(body.triangles());
}

}  // namespace

int closedSurfaceCount(const Body& body) {
  return std::visit([](const auto& each) { return countOf(each); }, body);
}

int closedSurfaceCount(std::span<const std::array<int, 3>> triangles) {
  int last = -1;
  for (const auto& [a, b, c] : triangles) last = std::max({last, a, b, c});
  DisjointSets vertices(static_cast<std::size_t>(last + 1));
  std::vector<bool> isUsed(static_cast<std::size_t>(last + 1), false);
  for (const auto& [a, b, c] : triangles) {
    vertices.join(a, b);
    vertices.join(b, c);
    for (const int vertex : {a, b, c}) isUsed[vertex] = true;
  }
  // A vertex without triangles remains alone.
  return vertices.count() - static_cast<int>(std::count(isUsed.begin(), isUsed.end(), false));
}

}  // namespace palpa::modeling
