#include "bem/model/collocation.h"

#include <cmath>

namespace palpa::bem {

std::vector<CollocationPoint> nodalCollocation(const BoundaryMesh& mesh) {
  std::vector<CollocationPoint> points(mesh.nodes.size());
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int node = mesh.triangles[t][corner];
      points[node] = {mesh.nodes[node], t, Eigen::Vector3d::Unit(corner)};
    }
  return points;
}

CollocationPoint shiftedCollocation(const BoundaryMesh& mesh, const TractionSlots& slots, int slot,
                                    double shift) {
  // The widest corner keeps the point farthest from the edges of the face.
  const int node = slots.slots[slot].node;
  int best = -1, bestCorner = 0;
  double widest = -1;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      if (slots.ofCorner[t][corner] != slot) continue;
      const auto& c = mesh.triangles[t];
      const Eigen::Vector3d a = mesh.nodes[c[(corner + 1) % 3]] - mesh.nodes[node];
      const Eigen::Vector3d b = mesh.nodes[c[(corner + 2) % 3]] - mesh.nodes[node];
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      if (angle > widest) {
        widest = angle;
        best = t;
        bestCorner = corner;
      }
    }
  Eigen::Vector3d weights = Eigen::Vector3d::Constant(0.5 * shift);
  weights[bestCorner] = 1.0 - shift;
  return {mesh.point(best, weights), best, weights};
}

}  // namespace palpa::bem
