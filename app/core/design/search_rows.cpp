#include "app/core/design/search_rows.h"

#include <algorithm>
#include <variant>

#include "app/core/design/stiffness_gradient.h"

namespace palpa::app {
namespace {

using Eigen::VectorXd;
using modeling::Design;

// Weights of the squared misses of targets (in logarithms), of the volume and of thicknesses (both
// relative), against the squares of the variables over their limit: targets are met to 1e-4 where
// the variables allow it, and yield to the limits.
constexpr double kTargetWeight = 1e5;
constexpr double kLimitWeight = 1e7;
/// Push of a volume that is to be small on the variable that matters most.
constexpr double kVolumePush = 4.0;
constexpr std::size_t kMaxWalls = 60;

/// Slope by the variables in parts of their limit.
VectorXd slopeOf(const Eigen::Matrix3Xd& gradient, double by, const DesignSpace& space) {
  return space.limit() / by * space.pullBack(gradient);
}

/// Rows of the walls that the variables could make too thin, the thinnest of them.
void addWalls(const SearchState& state, const DesignSpace& space, const ShapeEvaluator& evaluator,
              SearchRows& rows) {
  struct Thin {
    const WallThickness* wall;
    double left;
  };
  std::vector<Thin> thin;
  for (const WallThickness& wall : state.walls) {
    const double least = evaluator.leastThickness(wall);
    if (least > 0 && wall.value < least + 4 * space.limit())
      thin.push_back({&wall, wall.value / least});
  }
  std::sort(thin.begin(), thin.end(), [](const Thin& a, const Thin& b) { return a.left < b.left; });
  if (thin.size() > kMaxWalls) thin.resize(kMaxWalls);
  const auto& solid = std::get<modeling::Solid>(state.project.body);
  for (const Thin& each : thin) {
    const double least = evaluator.leastThickness(*each.wall);
    rows.problem.rows.push_back({slopeOf(each.wall->gradient(solid), least, space), each.left,
                                 1 + SearchMerit::kThicknessMargin, kLimitWeight, true});
    rows.walls.push_back(*each.wall);
  }
}

}  // namespace

SearchRows rowsAt(const SearchState& state, const Design& design, const DesignSpace& space,
                  const ShapeEvaluator& evaluator, const SearchMerit& merit, const Job& job) {
  SearchRows rows;
  StepProblem& problem = rows.problem;
  problem.present = state.y / space.limit();
  problem.push = VectorXd::Zero(problem.present.size());
  const StiffnessGradients gradients(state.project, *state.model, job);
  rows.targets = design.targets.size();
  // A force at a depth changes like the stiffness, apart from contacts that grow with depth.
  for (std::size_t i = 0; i < rows.targets; ++i) {
    const StiffnessGradient gradient = gradients.of(state.rules[i], job);
    problem.rows.push_back({slopeOf(gradient.gradient, gradient.stiffness, space),
                            merit.miss(state.values, i), 0, kTargetWeight * merit.weightOf(i),
                            false});
  }
  rows.volumeSlope = slopeOf(volumeOf(gradients.surface()).gradient, merit.firstVolume(), space);
  rows.volume = state.volume / merit.firstVolume();
  rows.hasVolume =
      design.volume == Design::Volume::kKept || design.volume == Design::Volume::kNotLarger;
  if (design.volume == Design::Volume::kKept)
    problem.rows.push_back({rows.volumeSlope, rows.volume, 1, kLimitWeight, false});
  if (design.volume == Design::Volume::kNotLarger)
    problem.rows.push_back({-rows.volumeSlope, -rows.volume, -1, kLimitWeight, true});
  const double steepest = rows.volumeSlope.cwiseAbs().maxCoeff();
  if (merit.minimisesVolume() && steepest > 0)
    problem.push = kVolumePush / steepest * rows.volumeSlope;
  addWalls(state, space, evaluator, rows);
  return rows;
}

}  // namespace palpa::app
