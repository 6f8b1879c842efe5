#include "base/support_border.h"

#include <algorithm>
#include <map>

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
                                        const std::vector<bool>& isSupported, int vertexCount) {
  const auto isBorder = supportBorderEdges(triangles, isSupported);
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

}  // namespace palpa
