#include "base/support_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace palpa {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// The vertex of a triangle to leave out, of those in `isOn`: one with the fewest edges on the
/// border; -1 if the triangle is as it should be.
int vertexToLeaveOut(const std::array<int, 3>& triangle, const std::array<bool, 3>& isBorder,
                     const std::vector<bool>& isOn) {
  const auto edgesAt = [&](int k) { return int{isBorder[k]} + int{isBorder[(k + 2) % 3]}; };
  const auto count =
      std::count_if(triangle.begin(), triangle.end(), [&](int v) { return isOn[v]; });
  if (count < 2) return -1;
  if (count == 2)
    for (int k = 0; k < 3; ++k)
      if (isBorder[k] && isOn[triangle[k]] && isOn[triangle[(k + 1) % 3]]) return -1;
  int found = -1;
  for (int k = 0; k < 3; ++k)
    if (isOn[triangle[k]] && (found < 0 || edgesAt(k) < edgesAt(found))) found = k;
  return triangle[found];
}

}  // namespace

std::vector<std::array<bool, 3>> supportBorderEdges(const Triangles& triangles,
                                                    const std::vector<bool>& isSupported) {
  std::map<std::pair<int, int>, int> sides;  // 1: of a supported triangle, 2: of a free one
  const auto forEdges = [&](const auto& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        visit(t, k, std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]));
  };
  forEdges(
      [&](std::size_t t, int, std::pair<int, int> edge) { sides[edge] |= isSupported[t] ? 1 : 2; });
  std::vector<std::array<bool, 3>> isBorder(triangles.size());
  forEdges([&](std::size_t t, int k, std::pair<int, int> edge) {
    isBorder[t][k] = sides.at(edge) == 3;
  });
  return isBorder;
}

std::vector<bool> supportBorderVertices(const Triangles& triangles,
                                        const std::vector<bool>& isSupported, int vertexCount,
                                        const std::vector<std::array<bool, 3>>& isNotch) {
  auto isBorder = supportBorderEdges(triangles, isSupported);
  for (std::size_t t = 0; t < isNotch.size(); ++t)
    for (int k = 0; k < 3; ++k) isBorder[t][k] = isBorder[t][k] || isNotch[t][k];
  std::vector<bool> isOn(static_cast<std::size_t>(vertexCount), false);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (isBorder[t][k]) isOn[triangles[t][k]] = isOn[triangles[t][(k + 1) % 3]] = true;
  for (bool hasChanged = true; hasChanged;) {
    hasChanged = false;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (const int vertex = vertexToLeaveOut(triangles[t], isBorder[t], isOn); vertex >= 0) {
        isOn[vertex] = false;
        hasChanged = true;
      }
  }
  return isOn;
}

std::vector<std::array<bool, 3>> notchEdges(const Triangles& triangles,
                                            const std::vector<Eigen::Vector3d>& positions,
                                            const std::vector<int>& groups,
                                            const std::vector<bool>& isSupported) {
  std::vector<std::array<bool, 3>> isNotch(triangles.size(), {false, false, false});
  constexpr double kAngle = 30 * std::numbers::pi / 180;
  const auto normal = [&](std::size_t t) -> Eigen::Vector3d {
    const auto& [a, b, c] = triangles[t];
    return (positions[b] - positions[a]).cross(positions[c] - positions[a]).normalized();
  };
  std::map<std::pair<int, int>, std::pair<std::size_t, int>> edges;  // by their direction
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      const auto found = edges.find({to, from});
      if (found == edges.end()) {
        edges[{from, to}] = {t, k};
        continue;
      }
      const auto [other, side] = found->second;
      if (groups[t] == groups[other] || isSupported[t] || isSupported[other]) continue;
      const Eigen::Vector3d n = normal(t), m = normal(other);
      const double angle =
          std::atan2(-n.cross(m).dot((positions[to] - positions[from]).normalized()), n.dot(m));
      if (angle >= kAngle) isNotch[t][k] = isNotch[other][side] = true;
    }
  return isNotch;
}

}  // namespace palpa
