#include "bem/contact/contact_surface.h"

#include <map>
#include <utility>

namespace palpa::bem {

using Eigen::Vector3d;

ContactSurface::ContactSurface(const BoundaryMesh& mesh, const TractionSlots& meshSlots,
                               const TractionSlots& slots, const DegreesOfFreedom& dofs)
    : mesh_(mesh),
      meshSlots_(meshSlots),
      slots_(slots),
      dofs_(dofs),
      tree_(mesh),
      acrossSharpEdge_(3 * mesh.triangles.size(), -1) {
  // Each edge appears once per direction.
  std::map<std::pair<int, int>, int> open;
  for (int edge = 0; edge < 3 * mesh.triangleCount(); ++edge) {
    const auto& c = mesh.triangles[edge / 3];
    const int from = c[edge % 3], to = c[(edge + 1) % 3];
    const auto other = open.find({to, from});
    if (other == open.end()) {
      open[{from, to}] = edge;
      continue;
    }
    const int twin = other->second;
    open.erase(other);
    if (mesh.smoothingGroups[edge / 3] == mesh.smoothingGroups[twin / 3]) continue;
    acrossSharpEdge_[edge] = twin / 3;
    acrossSharpEdge_[twin] = edge / 3;
  }
}

double ContactSurface::maskRadius(const SurfacePoint& point, double radius) const {
  constexpr double kSmooth = 0.1;
  const double narrowest = narrowestMask(point);
  if (narrowest <= radius) return radius;
  // The cubic with slopes 0 and 1 at its ends.
  const double t = (narrowest - radius) / (kSmooth * radius);
  return t >= 1 ? narrowest : radius * (1 + kSmooth * t * t * (2 - t));
}

SurfacePoint ContactSurface::facing(const SurfacePoint& point, const Vector3d& direction) const {
  constexpr double kOnEdge = 1e-9;
  SurfacePoint best = point;
  double most = normal(point).dot(direction);
  for (int corner = 0; corner < 3; ++corner) {
    const int across = acrossSharpEdge_[3 * point.triangle + corner];
    if (across < 0 || point.weights[(corner + 2) % 3] > kOnEdge) continue;
    SurfacePoint other = point;
    other.triangle = across;
    other.weights.setZero();
    for (const int k : {corner, (corner + 1) % 3})
      for (int i = 0; i < 3; ++i)
        if (mesh_.triangles[across][i] == mesh_.triangles[point.triangle][k])
          other.weights[i] = point.weights[k];
    const double along = normal(other).dot(direction);
    if (along <= most + kOnEdge) continue;
    most = along;
    best = other;
  }
  return best;
}

}  // namespace palpa::bem
