#include "bench/peers/surface_mask.h"

#include <algorithm>
#include <map>

namespace palpa::bench {

using Eigen::Vector3d;

SurfaceMask makeSurfaceMask(const TetrahedralMesh& mesh, const Vector3d& at, double radius) {
  std::vector<int> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& nodes = mesh.faces[f];
    const Vector3d &a = mesh.nodes[nodes[0]], &b = mesh.nodes[nodes[1]], &c = mesh.nodes[nodes[2]];
    const Vector3d middle = (a + b + c) / 3;
    const double reach = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
    if ((middle - at).norm() < radius + 1.1 * reach) faces.push_back(static_cast<int>(f));
  }
  std::map<int, double> weights;
  double total = 0;
  // In parts, because the bump is no polynomial on a face that its edge crosses.
  visitFaces(
      mesh, faces, 2,
      [&](int face, const FaceFunctions& functions, const Vector3d& x, const Vector3d& area) {
        const double rest = 1 - (x - at).squaredNorm() / (radius * radius);
        if (rest <= 0) return;
        const double weight = rest * rest * area.norm();
        total += weight;
        for (int k = 0; k < mesh.faceNodes(); ++k)
          weights[mesh.faces[face][k]] += weight * functions.value[k];
      });
  SurfaceMask mask;
  for (const auto& [node, weight] : weights) {
    mask.nodes.push_back(node);
    mask.weights.push_back(weight / total);
  }
  return mask;
}

}  // namespace palpa::bench
