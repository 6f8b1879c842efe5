#include "modeling/body/closed_surfaces.h"

#include <numeric>
#include <vector>

namespace palpa::modeling {
namespace {

/// Sets of connected items.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void connect(int a, int b) { parent_[root(a)] = root(b); }
  int root(int item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }

 private:
  std::vector<int> parent_;
};

int countOf(const Solid& solid) {
  Components patches(solid.patches().size());
  for (const SolidEdge& edge : solid.edges())
    patches.connect(edge.uses[0].patch, edge.uses[1].patch);
  int count = 0;
  for (int patch = 0; patch < static_cast<int>(solid.patches().size()); ++patch)
    if (patches.root(patch) == patch) ++count;
  return count;
}

int countOf(const MeshBody& body) {
  Components vertices(body.positions().size());
  std::vector<bool> isUsed(body.positions().size(), false);
  for (const auto& [a, b, c] : body.triangles()) {
    vertices.connect(a, b);
    vertices.connect(b, c);
    for (const int vertex : {a, b, c}) isUsed[vertex] = true;
  }
  int count = 0;
  for (int vertex = 0; vertex < static_cast<int>(isUsed.size()); ++vertex)
    if (isUsed[vertex] && vertices.root(vertex) == vertex) ++count;
  return count;
}

}  // namespace

int closedSurfaceCount(const Body& body) {
  return std::visit([](const auto& each) { return countOf(each); }, body);
}

}  // namespace palpa::modeling
