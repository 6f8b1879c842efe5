#include "app/core/design/search_limits.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

using Kind = ShapeLimit::Kind;

/// Variables nearer than this to a bound are at it.
constexpr double kAtBound = 1e-6;
/// A target whose logarithm all variables together change by less hardly depends on the points, if
/// they move by this share of the body's size or, where that is more, by what is allowed. Below it
/// the allowed movement is the limit.
constexpr double kNoInfluence = 0.01, kUsualMovement = 0.02;

std::string countText(long count, long of) {
  return std::to_string(count) + " of " + std::to_string(of);
}

/// The usual movement over the allowed one, at least 1.
double usualMovementOverAllowed(const DesignSpace& space) {
  const auto [low, high] = modeling::boundingBox(space.solid());
  return std::max(1.0, kUsualMovement * (high - low).norm() / space.limit());
}

ShapeLimit thicknessLimit(const modeling::Design& design, const DesignSpace& space, int patch) {
  return {Kind::kThickness, "the smallest thickness of " + numberText(*design.smallestThickness) +
                                " mm, for example at the patch \"" +
                                space.solid().patches()[static_cast<std::size_t>(patch)].name +
                                "\""};
}

}  // namespace

std::vector<ShapeLimit> findLimits(SearchRows rows, const modeling::Design& design,
                                   const DesignSpace& space, const SearchTroubles& troubles) {
  std::vector<ShapeLimit> limits;
  rows.problem.radius = 2;  // none
  const StepSolution solution = solveStep(rows.problem);
  const double toUsual = usualMovementOverAllowed(space);
  bool isMissed = false;
  for (std::size_t i = 0; i < rows.targets; ++i) {
    const StepProblem::Row& row = rows.problem.rows[i];
    isMissed = isMissed || std::abs(row.goal - solution.values[i]) > design.tolerance;
    if (row.slope.cwiseAbs().sum() * toUsual < kNoInfluence)
      limits.push_back({Kind::kPoints, "the points that may move hardly change the touch \"" +
                                           design.targets[i].touch +
                                           "\"; select points near it, or below it"});
  }
  if (isMissed) {
    const long atBound = (solution.x.cwiseAbs().array() > 1 - kAtBound).count();
    if (atBound > 0)
      limits.push_back({Kind::kMovement, "the largest movement of " + numberText(space.limit()) +
                                             " mm: " + countText(atBound, solution.x.size()) +
                                             " variables of the shape reach it"});
    if (rows.hasVolume && std::abs(solution.pressure[rows.targets]) > 0)
      limits.push_back({Kind::kVolume, design.volume == modeling::Design::Volume::kKept
                                           ? "the volume, which is kept"
                                           : "the volume, which may not grow"});
    const std::size_t firstWall = rows.targets + (rows.hasVolume ? 1 : 0);
    int thin = -1;
    for (std::size_t k = 0; k < rows.walls.size(); ++k)
      if (solution.pressure[firstWall + k] > 0) thin = rows.walls[k].patch;
    if (thin >= 0) limits.push_back(thicknessLimit(design, space, thin));
  }
  const bool isThin = std::any_of(limits.begin(), limits.end(), [](const ShapeLimit& limit) {
    return limit.kind == Kind::kThickness;
  });
  if (troubles.thinPatch >= 0 && !isThin)
    limits.push_back(thicknessLimit(design, space, troubles.thinPatch));
  if (troubles.jump > 0)
    limits.push_back({Kind::kElements, "the computed values jump by " +
                                           numberText(std::round(1000 * troubles.jump) / 10) +
                                           " % where other elements are chosen; ask for more "
                                           "accuracy or a fixed element length"});
  if (!troubles.refusal.empty())
    limits.push_back({Kind::kFolding, "shapes further on cannot be computed: " + troubles.refusal});
  if (!troubles.hasStepsLeft)
    limits.push_back({Kind::kSteps, "the number of steps (" + std::to_string(design.steps) +
                                        "): more steps may come nearer"});
  if (limits.empty())
    limits.push_back({Kind::kTargets, rows.targets > 1
                                          ? "the targets contradict each other for the points that "
                                            "may move"
                                          : "no small change of the shape comes nearer"});
  return limits;
}

}  // namespace palpa::app
