#include "modeling/editing/carry_strokes.h"

#include <optional>

#include "modeling/editing/nearest_on_patches.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

template <class What>
void forStrokes(Project& project, What what) {
  const auto visit = [&](Region& region) {
    for (auto* parts : {&region.parts, &region.except})
      for (RegionPart& part : *parts)
        if (auto* stroke = std::get_if<Stroke>(&part)) what(*stroke);
  };
  for (Support& support : project.supports) visit(support.where);
  for (Load& load : project.loads)
    if (Region* where = regionOf(load)) visit(*where);
}

/// Cache of the last nearest points, because all commands of a drag need the same ones.
struct Memory {
  Solid solid;
  std::vector<Vector3d> points;
  std::vector<SurfaceSum> places;
};

const std::vector<SurfaceSum>& placesOf(const Solid& solid, std::vector<Vector3d> points) {
  static thread_local std::optional<Memory> last;
  if (last && last->solid.sharesTopologyWith(solid) && last->points == points &&
      last->solid.controlPoints() == solid.controlPoints())
    return last->places;
  NearestOnPatches nearest(solid);
  std::vector<SurfaceSum> places;
  for (const Vector3d& point : points) places.push_back(nearest.of(point));
  last = Memory{solid, std::move(points), std::move(places)};
  return last->places;
}

}  // namespace

void carryStrokes(const Solid& before, Project& project) {
  const Solid& after = std::get<Solid>(project.body);
  std::vector<Vector3d> points;
  forStrokes(project, [&](const Stroke& stroke) {
    points.insert(points.end(), stroke.points.begin(), stroke.points.end());
  });
  if (points.empty() || before.controlPoints() == after.controlPoints()) return;
  auto place = placesOf(before, std::move(points)).begin();
  forStrokes(project, [&](Stroke& stroke) {
    for (Vector3d& point : stroke.points) {
      Vector3d moved = Vector3d::Zero();
      for (const auto& [control, weight] : *place)
        moved += weight * (after.controlPoints()[control] - before.controlPoints()[control]);
      if (moved != Vector3d::Zero()) point += moved;
      ++place;
    }
  });
}

}  // namespace palpa::modeling
