#include "bem/triangle/triangle_contact_surface.h"

#include <algorithm>

#include "bem/model/displacement_recovery.h"

namespace palpa::bem {

using Eigen::Vector3d;

TriangleContactSurface::TriangleContactSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                                               const DegreesOfFreedom& dofs)
    : ContactSurface(mesh, slots, slots, dofs) {
  const int count = mesh.triangleCount();
  triangles_.reserve(count);
  longestAt_.assign(mesh.nodeCount(), 0.0);
  firstOfNode_.assign(mesh.nodeCount() + 1, 0);
  for (int t = 0; t < count; ++t) {
    const auto& c = mesh.triangles[t];
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.nodes[c[(k + 1) % 3]] - mesh.nodes[c[k]]).norm());
    triangles_.push_back({mesh.area(t), longest});
    for (const int node : c) {
      ++firstOfNode_[node + 1];
      longestAt_[node] = std::max(longestAt_[node], longest);
    }
  }
  for (int node = 0; node < mesh.nodeCount(); ++node) firstOfNode_[node + 1] += firstOfNode_[node];
  ofNode_.resize(3 * static_cast<std::size_t>(count));
  std::vector<int> next(firstOfNode_.begin(), firstOfNode_.end() - 1);
  for (int t = 0; t < count; ++t)
    for (const int node : mesh.triangles[t]) ofNode_[next[node]++] = t;

  const DisplacementRecovery recovery(mesh, slots);
  firstBulge_.reserve(3 * static_cast<std::size_t>(count) + 1);
  for (int t = 0; t < count; ++t)
    for (int a = 0; a < 3; ++a) {
      firstBulge_.push_back(static_cast<int>(bulges_.size()));
      for (const auto& [node, weight] : recovery.bulge(t, a)) bulges_.push_back({node, weight});
    }
  firstBulge_.push_back(static_cast<int>(bulges_.size()));
}

Vector3d TriangleContactSurface::normal(const SurfacePoint& point) const {
  Vector3d normal = Vector3d::Zero();
  for (int corner = 0; corner < 3; ++corner)
    normal +=
        point.weights[corner] * slots().slots[slots().ofCorner[point.triangle][corner]].normal;
  const double length = normal.norm();
  return length > 0 ? Vector3d(normal / length) : mesh().normal(point.triangle);
}

Vector3d TriangleContactSurface::smoothPosition(const SurfacePoint& point) const {
  Vector3d position = point.position;
  for (int a = 0; a < 3; ++a) {
    const double both = point.weights[a] * point.weights[(a + 1) % 3];
    for (const Weight& weight : bulge(point.triangle, a))
      position += both * weight.weight * mesh().nodes[weight.node];
  }
  return position;
}

double TriangleContactSurface::narrowestMask(const SurfacePoint& point) const {
  double length = 0;
  for (int corner = 0; corner < 3; ++corner)
    length += point.weights[corner] * longestAt_[mesh().triangles[point.triangle][corner]];
  return kMinWidth * length;
}

}  // namespace palpa::bem
