#include "bem/quadratic/quartered_mesh.h"

#include <algorithm>
#include <map>

#include "base/support_border.h"
#include "bem/quadratic/border_coordinates.h"

namespace palpa::bem {

std::vector<bool> areSupported(const std::vector<int>& tags, const std::vector<int>& supportTags) {
  std::vector<bool> supported;
  for (const int tag : tags)
    supported.push_back(std::find(supportTags.begin(), supportTags.end(), tag) !=
                        supportTags.end());
  return supported;
}

BoundaryMesh quarteredMesh(const BoundaryMesh& corners,
                           const std::function<Eigen::Vector3d(int, int, double)>& middle,
                           const std::vector<int>& supportTags, bool isPlain) {
  std::vector<bool> isBorderVertex(corners.nodes.size(), false);
  if (!isPlain) {
    const std::vector<bool> isSupported = areSupported(corners.tags, supportTags);
    isBorderVertex = supportBorderVertices(
        corners.triangles, isSupported, corners.nodeCount(),
        notchEdges(corners.triangles, corners.nodes, corners.smoothingGroups, isSupported));
  }
  BoundaryMesh mesh;
  mesh.nodes = corners.nodes;
  std::map<std::pair<int, int>, int> middles;
  for (int t = 0; t < corners.triangleCount(); ++t) {
    std::array<int, 6> node{};
    for (int k = 0; k < 3; ++k) {
      const int from = corners.triangles[t][k], to = corners.triangles[t][(k + 1) % 3];
      node[k] = from;
      const auto [known, isNew] =
          middles.try_emplace(std::minmax(from, to), static_cast<int>(mesh.nodes.size()));
      const double share = !isBorderEdge(isBorderVertex, from, to) ? 0.5
                           : isBorderVertex[from]                  ? kBorderEdgeShare
                                                                   : 1 - kBorderEdgeShare;
      if (isNew) mesh.nodes.push_back(middle(t, k, share));
      node[3 + k] = known->second;
    }
    for (const auto& quarter : kQuarters) {
      mesh.triangles.push_back({node[quarter[0]], node[quarter[1]], node[quarter[2]]});
      mesh.smoothingGroups.push_back(corners.smoothingGroups[t]);
      mesh.tags.push_back(corners.tags[t]);
    }
  }
  return mesh;
}

}  // namespace palpa::bem
