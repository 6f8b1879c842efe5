#include "modeling/mesh/divided_triangles.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace palpa::modeling {

std::optional<FacedTriangles> dividedTriangles(FacedTriangles surface, double length,
                                               std::size_t most) {
  for (bool hasLong = true; hasLong;) {
    hasLong = false;
    std::map<std::pair<int, int>, int> middles;
    const auto middleOf = [&](int a, int b) {
      const auto [known, isNew] = middles.try_emplace(std::minmax(a, b), -1);
      if (isNew && (surface.positions[a] - surface.positions[b]).norm() > length) {
        known->second = static_cast<int>(surface.positions.size());
        surface.positions.push_back((surface.positions[a] + surface.positions[b]) / 2);
      }
      return known->second;
    };
    std::vector<std::array<int, 3>> triangles;
    std::vector<int> faces;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      // Halves of the longest edge first, so that pieces stay round.
      const std::array<int, 3> n = surface.triangles[t];
      std::array<int, 3> middle{};
      int longest = 0;
      const auto lengthOf = [&](int k) {
        return (surface.positions[n[k]] - surface.positions[n[(k + 1) % 3]]).norm();
      };
      for (int k = 0; k < 3; ++k) {
        middle[k] = middleOf(n[k], n[(k + 1) % 3]);
        if (lengthOf(k) > lengthOf(longest)) longest = k;
      }
      const auto add = [&](int a, int b, int c) {
        triangles.push_back({a, b, c});
        faces.push_back(surface.faceOfTriangle[t]);
      };
      const int a = n[longest], b = n[(longest + 1) % 3], c = n[(longest + 2) % 3],
                ab = middle[longest], bc = middle[(longest + 1) % 3],
                ca = middle[(longest + 2) % 3];
      if (ab < 0) {
        add(a, b, c);
        continue;
      }
      hasLong = true;
      if (bc < 0) {
        add(ab, b, c);
      } else {
        add(ab, b, bc);
        add(ab, bc, c);
      }
      if (ca < 0) {
        add(a, ab, c);
      } else {
        add(a, ab, ca);
        add(ca, ab, c);
      }
    }
    surface.triangles = std::move(triangles);
    surface.faceOfTriangle = std::move(faces);
    if (surface.triangles.size() > most) return std::nullopt;
  }
  return surface;
}

}  // namespace palpa::modeling
