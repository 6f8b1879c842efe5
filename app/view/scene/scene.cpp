#include "app/view/scene/scene.h"

namespace palpa::view {

std::vector<std::vector<int>> linesBetween(const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::vector<int>> lines;
  lines.reserve(pairs.size());
  for (const auto& [a, b] : pairs) lines.push_back({a, b});
  return lines;
}

std::vector<double> regionOfTriangles(const std::vector<Triangle>& triangles,
                                      const std::vector<bool>& isInside, std::size_t pointCount) {
  // Slightly inside: a triangle of the region with three corners on the border is still in it.
  constexpr double kOnBorder = -1e-3;
  std::vector<double> region(pointCount, 1.0);
  std::vector<bool> isOutside(pointCount, false);
  bool any = false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    any = any || isInside[t];
    for (const int corner : triangles[t]) {
      const auto i = static_cast<std::size_t>(corner);
      if (isInside[t])
        region[i] = -1.0;
      else
        isOutside[i] = true;
    }
  }
  if (!any) return {};
  for (std::size_t i = 0; i < pointCount; ++i)
    if (region[i] < 0 && isOutside[i]) region[i] = kOnBorder;
  return region;
}

}  // namespace palpa::view
