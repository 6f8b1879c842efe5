#include "bem/model/displacement_recovery.h"

namespace palpa::bem {

using Eigen::Vector3d;

std::map<int, double> DisplacementRecovery::bulge(int triangle, int a) const {
  const int b = (a + 1) % 3;
  const auto& nodes = mesh_.triangles[triangle];
  const Vector3d along = mesh_.nodes[nodes[b]] - mesh_.nodes[nodes[a]];
  std::map<int, double> weights;
  addGradient(slots_.ofCorner[triangle][a], along, 0.5, weights);
  addGradient(slots_.ofCorner[triangle][b], along, -0.5, weights);
  return weights;
}

void DisplacementRecovery::addGradient(int slot, const Vector3d& direction, double factor,
                                       std::map<int, double>& weights) const {
  double area = 0;
  for (const int t : trianglesOfSlot_[slot]) area += mesh_.area(t);
  for (const int t : trianglesOfSlot_[slot]) {
    // area grad λ_k = n × (edge opposite to k) / 2, so the triangle's area cancels.
    const Vector3d normal = mesh_.normal(t);
    const auto& c = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const Vector3d opposite = mesh_.nodes[c[(k + 2) % 3]] - mesh_.nodes[c[(k + 1) % 3]];
      weights[c[k]] += factor * 0.5 * normal.cross(opposite).dot(direction) / area;
    }
  }
}

}  // namespace palpa::bem
