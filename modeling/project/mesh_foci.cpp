#include "modeling/project/mesh_foci.h"

#include <algorithm>
#include <cmath>

#include "modeling/mesh/mesh.h"

namespace palpa::modeling {
namespace {

/// Distance of adjacent nodes over the radius of a pressure mask. Masks are at least 1.25 times as
/// wide as the longest edge at a node of linear triangles, or once the longest edge of quadratic
/// ones, which is about three times the distance of their nodes.
double shareOfRadius(Engine engine) {
  return engine == Engine::kQuadratic ? 0.3 : 0.42;
}

/// Factor on that share under balls, whose area of contact takes several masks: it is found by
/// switching them on and off.
constexpr double kShareUnderBalls = 0.6;

/// Radius of the area that a touch loads, mm; 0 if it is not known.
double loadedRadius(const Touch& touch) {
  if (!touch.radius) return 0;
  const TouchKindInfo& info = infoOf(touch.kind);
  if (!info.isBall) return *touch.radius;
  // Hertz: a ball pressed into an elastic half space by d touches within sqrt(R d).
  return info.isForce ? 0 : std::sqrt(*touch.radius * std::min(touch.vector.norm(), *touch.radius));
}

}  // namespace

double edgeLengthPerTouchRadius(Engine engine) {
  return engine == Engine::kSplines ? 0 : shareOfRadius(engine);
}

std::vector<MeshFocus> meshFoci(const Project& project) {
  const Engine engine = engineOf(project);
  std::vector<MeshFocus> foci;
  if (engine == Engine::kSplines) return foci;
  const double usual = project.mesh.edgeLength;
  const bool leavesPartsOut = std::holds_alternative<MeshBody>(project.body);
  const auto add = [&](const Eigen::Vector3d& center, double radius, double share = 1) {
    const double length = share * shareOfRadius(engine) * radius;
    if (radius > 0 && length < usual)
      foci.push_back({center, radius, length});
    else if (leavesPartsOut)
      foci.push_back({center, usual, usual});
  };
  for (const Touch& touch : project.touches)
    add(touch.at, loadedRadius(touch), infoOf(touch.kind).isBall ? kShareUnderBalls : 1);
  for (const Load& load : project.loads)
    if (const auto* bump = std::get_if<Bump>(&load.what)) add(bump->center, bump->radius);
  return foci;
}

}  // namespace palpa::modeling
