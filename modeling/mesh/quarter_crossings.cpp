#include "modeling/mesh/quarter_crossings.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {

std::size_t quarterCrossings(const SurfaceMesh& mesh, std::size_t most, const Job& job) {
  std::vector<Eigen::Vector3d> positions = mesh.positions;
  std::vector<std::array<int, 3>> quarters;
  std::map<std::pair<int, int>, int> middles;
  const auto middleOf = [&](int a, int b) {
    const std::pair<int, int> ends = std::minmax(a, b);
    const auto [found, isNew] = middles.try_emplace(ends, static_cast<int>(positions.size()));
    if (isNew)
      positions.push_back(0.5 * mesh.positions[ends.first] + 0.5 * mesh.positions[ends.second]);
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middleOf(a, b), bc = middleOf(b, c), ca = middleOf(c, a);
    quarters.insert(quarters.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return triangleCrossings(positions, quarters, most, job).size();
}

}  // namespace palpa::modeling
