#include "app/core/setup/project_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/core/setup/support_borders.h"
#include "modeling/mesh/mesh.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

/// Half the width of a thumb's contact under a firm press, mm.
constexpr double kFingertipRadius = 6.0;

std::vector<int> groupsOf(const modeling::Solid& solid,
                          const modeling::SurfaceEvaluator& evaluator) {
  return modeling::smoothingGroups(solid, modeling::sharpEdges(solid, evaluator));
}

}  // namespace

double defaultTouchRadius(double bodySize) {
  return std::min(kFingertipRadius, 0.2 * bodySize / std::sqrt(3.0));
}

double radiusOfFirstTouch(double bodySize) {
  return std::max(defaultTouchRadius(bodySize), 0.05 * bodySize);
}

double fingertipRadius(const modeling::Project& project) {
  std::optional<double> narrowest;
  for (const modeling::Touch& touch : project.touches)
    if (touch.radius && !modeling::infoOf(touch.kind).isBall)
      narrowest = std::min(narrowest.value_or(*touch.radius), *touch.radius);
  const auto [low, high] = modeling::boundingBox(project.body);
  return std::max(narrowest.value_or(0), defaultTouchRadius((high - low).norm()));
}

bool usesSplines(const modeling::Project& project) {
  return modeling::engineOf(project) == modeling::Engine::kSplines;
}

ProjectGeometry::ProjectGeometry(const modeling::Project& project)
    : project_(project), regions_(modeling::meshRegions(project)) {
  if (!app::usesSplines(project)) return;
  const modeling::SurfaceEvaluator evaluator(solid());
  const auto sizes = ElementSizes::of(project.mesh, fingertipRadius(project));
  patches_ =
      Patches{evaluator, groupsOf(solid(), evaluator), splineRefinement(project, evaluator, sizes)};
}

ProjectGeometry::ProjectGeometry(const modeling::Project& project, SplineRefinement refinement)
    : project_(project), regions_(modeling::meshRegions(project)) {
  const modeling::SurfaceEvaluator evaluator(solid());
  refinement.hasRoots = haveRoots(project.supports, solid(), evaluator);
  patches_ = Patches{evaluator, groupsOf(solid(), evaluator), std::move(refinement)};
}

}  // namespace palpa::app
