#include "modeling/mesh/quadratic_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <type_traits>
#include <utility>

#include "base/support_border.h"
#include "modeling/mesh/middle_nodes.h"
#include "modeling/mesh/support_chords.h"
#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// True if the area vector of a six-node triangle at a node, or of a quarter, points far from the
/// one in the middle or is much smaller.
bool isFolded(const std::array<Vector3d, 6>& x) {
  constexpr double kLeast = 0.2;
  const auto areaAt = [&x](double u, double v) {
    const double w = 1 - u - v;
    const Vector3d du =
        (1 - 4 * w) * x[0] + (4 * u - 1) * x[1] + 4 * (w - u) * x[3] + 4 * v * (x[4] - x[5]);
    const Vector3d dv =
        (1 - 4 * w) * x[0] + (4 * v - 1) * x[2] + 4 * u * (x[4] - x[3]) + 4 * (w - v) * x[5];
    return Vector3d(du.cross(dv));
  };
  const Vector3d middle = areaAt(1.0 / 3, 1.0 / 3);
  const auto isFar = [&](const Vector3d& area) {
    return !(area.dot(middle) > kLeast * middle.squaredNorm());
  };
  constexpr double kNodes[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  for (const auto& [u, v] : kNodes)
    if (isFar(areaAt(u, v))) return true;
  constexpr int kQuarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  return std::any_of(std::begin(kQuarters), std::end(kQuarters), [&](const int(&q)[3]) {
    return isFar(4 * (x[q[1]] - x[q[0]]).cross(x[q[2]] - x[q[0]]));
  });
}

/// The middle of the quadratic curve through the nodes of an edge.
Vector3d curveMiddle(const Vector3d& from, const Vector3d& node, const Vector3d& to, double share) {
  if (share == 0.5) return node;
  const double a = share, weight = 1 / (4 * a * (1 - a));
  return (2 * a - 1) / (4 * a) * from + weight * node + (1 - 2 * a) / (4 * (1 - a)) * to;
}

std::vector<std::array<int, 3>> quartersOf(const std::vector<std::array<int, 6>>& elements) {
  std::vector<std::array<int, 3>> quarters;
  for (const auto& [a, b, c, ab, bc, ca] : elements)
    for (const auto& quarter : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                                std::array{ab, bc, ca}})
      quarters.push_back(quarter);
  return quarters;
}

SurfaceMesh withMiddles(const SurfaceMesh& corners, const std::vector<bool>& isBorderVertex,
                        const MiddleNodes& middles) {
  SurfaceMesh mesh = corners;
  const auto edges = elementEdges(corners, isBorderVertex);
  std::map<std::pair<int, int>, int> nodeOf;
  for (const auto& [nodes, edge] : edges) {
    nodeOf[nodes] = static_cast<int>(mesh.positions.size());
    const MiddleNode middle = middles.of(edge);
    mesh.positions.push_back(middle.position);
    if (!corners.parameters.empty()) mesh.parameters.push_back(middle.parameter);
  }
  const auto shareIn = [&](const std::array<int, 6>& element, int k) {
    return middleShare(isBorderVertex, element[k], element[(k + 1) % 3]);
  };
  std::vector<std::array<int, 6>> elements;
  for (const auto& t : corners.triangles) {
    std::array<int, 6>& element = elements.emplace_back();
    for (int k = 0; k < 3; ++k) {
      element[k] = t[k];
      element[3 + k] = nodeOf.at(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  // Straightens the edges of an element; returns whether that changed one.
  const auto straighten = [&](const std::array<int, 6>& element) {
    bool hasChanged = false;
    for (int k = 0; k < 3; ++k) {
      // From the smaller index, to the same bits in both elements of the edge.
      const bool isUp = element[k] < element[(k + 1) % 3];
      const int from = element[isUp ? k : (k + 1) % 3], to = element[isUp ? (k + 1) % 3 : k];
      const double share = middleShare(isBorderVertex, from, to);
      const Vector3d onEdge = (1 - share) * mesh.positions[from] + share * mesh.positions[to];
      Vector3d& node = mesh.positions[element[3 + k]];
      hasChanged = hasChanged || onEdge != node;
      node = onEdge;
    }
    return hasChanged;
  };
  // Straight edges of one element may fold another: until nothing changes.
  for (bool hasChanged = true; hasChanged;) {
    hasChanged = false;
    for (const auto& element : elements) {
      std::array<Vector3d, 6> x;
      for (int k = 0; k < 3; ++k) x[k] = mesh.positions[element[k]];
      for (int k = 0; k < 3; ++k)
        x[3 + k] =
            curveMiddle(x[k], mesh.positions[element[3 + k]], x[(k + 1) % 3], shareIn(element, k));
      if (isFolded(x) && straighten(element)) hasChanged = true;
    }
    // Curved elements may also cut through others, as flat ones do not.
    if (!hasChanged && corners.parameters.empty())
      for (const TriangleCrossing& crossing :
           triangleCrossings(mesh.positions, quartersOf(elements)))
        for (const int t : {crossing.a, crossing.b})
          if (straighten(elements[t / 4])) hasChanged = true;
  }
  const auto fourTimes = [](const auto& list) {
    std::decay_t<decltype(list)> result;
    for (const auto& value : list) result.insert(result.end(), 4, value);
    return result;
  };
  mesh.isQuadratic = true;
  mesh.triangles = quartersOf(elements);
  mesh.patchOfTriangle = fourTimes(corners.patchOfTriangle);
  mesh.smoothingGroupOfTriangle = fourTimes(corners.smoothingGroupOfTriangle);
  mesh.bordersOfTriangle = fourTimes(corners.bordersOfTriangle);
  for (std::vector<int>& region : mesh.trianglesOfRegion) {
    std::vector<int> quarters;
    for (const int t : region)
      for (int q = 0; q < 4; ++q) quarters.push_back(4 * t + q);
    region = std::move(quarters);
  }
  return mesh;
}

}  // namespace

SurfaceMesh quadraticMesh(SurfaceMesh corners, const Body& body, std::vector<bool> isSupported) {
  const auto middles = makeMiddleNodes(corners, body);
  if (isSupported.empty()) isSupported.assign(corners.triangles.size(), false);
  splitSupportChords(corners, isSupported, *middles);
  return withMiddles(corners,
                     supportBorderVertices(
                         corners.triangles, isSupported, static_cast<int>(corners.positions.size()),
                         notchEdges(corners.triangles, corners.positions,
                                    corners.smoothingGroupOfTriangle, isSupported)),
                     *middles);
}

}  // namespace palpa::modeling
