#include "app/core/design/shape_search.h"

#include <algorithm>
#include <cmath>

#include "app/core/design/search_limits.h"
#include "app/core/design/search_state.h"
#include "app/core/design/step_problem.h"
#include "app/core/design/stiffness_gradient.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using modeling::Design;
using modeling::DesignTarget;

// Weights of the squared misses of targets (in logarithms), of the volume and of thicknesses (both
// relative), against the squares of the variables over their limit: targets are met to 1e-4 where
// the variables allow it, and yield to the limits.
constexpr double kTargetWeight = 1e5;
constexpr double kLimitWeight = 1e7;
/// Share of limits in the measure of progress, per squared relative violation.
constexpr double kViolationShare = 100.0;
/// Share of the volume in the measure of progress if it is to be small.
constexpr double kVolumeShare = 0.02;
/// Push of a volume that is to be small on the variable that matters most.
constexpr double kVolumePush = 4.0;
/// Relative violations of limits that are rounding of the search.
constexpr double kLimitTolerance = 1e-3;
/// Thicknesses aim higher by this part, so that the curvature of their change does not violate
/// them.
constexpr double kThicknessMargin = 2e-3;
/// Steps shorter than this (in parts of the limit) should do what the rows promise.
constexpr double kSmallStep = 0.1;
constexpr double kFirstRadius = 0.5, kMinRadius = 1e-3;
constexpr int kMaxWalls = 60;

/// Measure of progress: what the search makes small.
struct Progress {
  double misfit = 0;     ///< Σ weight ln²(value / target)
  double violation = 0;  ///< of the volume and thicknesses, relative, the largest
  double volume = 1;     ///< over the first one
};

class Search {
 public:
  Search(const modeling::Project& project, const Design& design, const ShapeSearchOptions& options,
         const Job& job)
      : design_(design),
        options_(options),
        job_(job),
        quiet_{job.stop, {}, job.threads},
        space_(project, design),
        evaluator_(project, design, space_, options.build) {
    for (const DesignTarget& target : design.targets)
      largestWeight_ = std::max(largestWeight_, target.weight);
  }

  ShapeResult run() {
    report(0);
    SearchState current = evaluator_.at(VectorXd::Zero(space_.variableCount()), quiet_);
    evaluator_.learnThicknesses(current);
    firstVolume_ = current.volume;
    record(current, true);
    SearchState best = current;
    bool isReached = isMet(current);
    SearchTroubles troubles;
    double radius = kFirstRadius;
    int slow = 0;
    SearchRows rows;
    while (!isReached || minimisesVolume()) {
      rows = rowsAt(current);
      bool isAccepted = false;
      while (!isAccepted && radius >= kMinRadius && shapes_ < design_.steps) {
        rows.problem.radius = radius;
        const StepSolution step = solveStep(rows.problem);
        const double before = progressOf(current), expected = expectedProgress(rows, step);
        const double length = (step.x - rows.problem.present).cwiseAbs().maxCoeff();
        if (before - expected < 1e-3 * std::min(before, kVolumeShare)) break;
        std::optional<SearchState> next = tryShape(step.x, troubles.refusal);
        if (!next) {
          radius = length / 4;
          continue;
        }
        const double gain = (before - progressOf(*next)) / (before - expected);
        isAccepted = gain > 0.1 || (!isReached && isMet(*next));
        record(*next, isAccepted);
        if (!isAccepted && length < kSmallStep) {
          troubles.jump = std::max(troubles.jump, jumpAt(*next, rows, step));
          for (const WallThickness& wall : next->walls)
            if (wall.value < (1 - kLimitTolerance) * evaluator_.leastThickness(wall))
              troubles.thinPatch = wall.patch;
        }
        if (gain < 0.5) radius = std::max(length, kMinRadius) * (gain < 0.1 ? 0.25 : 0.5);
        if (gain > 0.75 && length > 0.9 * radius) radius = std::min(2 * radius, 2.0);
        if (!isAccepted) continue;
        slow = before - progressOf(*next) < 0.02 * before ? slow + 1 : 0;
        troubles.refusal.clear();
        current = std::move(*next);
      }
      if (!isAccepted) break;
      if (isBetter(current, best)) best = current;
      isReached = isReached || isMet(current);
      if (slow >= 3 || shapes_ >= design_.steps) break;
    }
    return resultOf(best, rows, troubles);
  }

 private:
  bool minimisesVolume() const { return design_.volume == Design::Volume::kMinimised; }

  double miss(const std::vector<double>& values, std::size_t target) const {
    return std::log(values[target] / design_.targets[target].value);
  }
  double weightOf(std::size_t target) const {
    return design_.targets[target].weight / largestWeight_;
  }

  double combined(const Progress& progress) const {
    return progress.misfit + kViolationShare * progress.violation * progress.violation +
           (minimisesVolume() ? kVolumeShare * progress.volume : 0);
  }

  double volumeViolation(double relative) const {
    if (design_.volume == Design::Volume::kKept) return std::abs(relative - 1);
    if (design_.volume == Design::Volume::kNotLarger) return std::max(0.0, relative - 1);
    return 0;
  }

  double violationOf(const SearchState& state) const {
    double violation = volumeViolation(state.volume / firstVolume_);
    for (const WallThickness& wall : state.walls)
      if (const double least = evaluator_.leastThickness(wall); least > 0)
        violation = std::max(violation, 1 - wall.value / least);
    return violation;
  }

  double progressOf(const SearchState& state) const {
    Progress progress{0, violationOf(state), state.volume / firstVolume_};
    for (std::size_t i = 0; i < design_.targets.size(); ++i)
      progress.misfit += weightOf(i) * std::pow(miss(state.values, i), 2);
    return combined(progress);
  }

  double expectedProgress(const SearchRows& rows, const StepSolution& step) const {
    Progress progress{0, 0, rows.problem.rows.empty() ? 1 : expectedVolume_(step.x)};
    for (std::size_t i = 0; i < rows.targets; ++i)
      progress.misfit += weightOf(i) * std::pow(rows.problem.rows[i].goal - step.values[i], 2);
    progress.violation = volumeViolation(progress.volume);
    for (std::size_t k = rows.problem.rows.size() - rows.walls.size(); k < rows.problem.rows.size();
         ++k)
      progress.violation = std::max(
          progress.violation, rows.problem.rows[k].goal / (1 + kThicknessMargin) - step.values[k]);
    return combined(progress);
  }

  /// Largest part by which a target misses what a small step promised, if that is more than the
  /// step itself: there the values jump.
  double jumpAt(const SearchState& state, const SearchRows& rows, const StepSolution& step) const {
    double jump = 0;
    for (std::size_t i = 0; i < rows.targets; ++i) {
      const double missed = std::abs(miss(state.values, i) - step.values[i]);
      if (missed > design_.tolerance &&
          missed > std::abs(step.values[i] - rows.problem.rows[i].value))
        jump = std::max(jump, missed);
    }
    return jump;
  }

  bool keepsLimits(const SearchState& state) const { return violationOf(state) <= kLimitTolerance; }

  bool isMet(const SearchState& state) const {
    for (std::size_t i = 0; i < design_.targets.size(); ++i)
      if (std::abs(state.values[i] / design_.targets[i].value - 1) > design_.tolerance)
        return false;
    return keepsLimits(state);
  }

  bool isBetter(const SearchState& state, const SearchState& than) const {
    if (!keepsLimits(state)) return false;
    if (isMet(state) != isMet(than)) return isMet(state);
    return progressOf(state) < progressOf(than);
  }

  /// Slope by the variables in parts of their limit.
  VectorXd slopeOf(const Eigen::Matrix3Xd& gradient, double by) const {
    return space_.limit() / by * space_.pullBack(gradient);
  }

  SearchRows rowsAt(const SearchState& state) {
    SearchRows result;
    StepProblem& problem = result.problem;
    problem.present = state.y / space_.limit();
    problem.push = VectorXd::Zero(problem.present.size());
    const StiffnessGradients gradients(state.project, *state.model, quiet_);
    result.targets = design_.targets.size();
    // A force at a depth changes like the stiffness, apart from contacts that grow with depth.
    for (std::size_t i = 0; i < result.targets; ++i) {
      const StiffnessGradient gradient = gradients.of(state.rules[i], quiet_);
      const double miss = this->miss(state.values, i);
      problem.rows.push_back({slopeOf(gradient.gradient, gradient.stiffness), miss, 0,
                              kTargetWeight * weightOf(i), false});
    }
    const ShapeMeasure volume = volumeOf(gradients.surface());
    const VectorXd bySpace = slopeOf(volume.gradient, firstVolume_);
    const double relative = state.volume / firstVolume_;
    expectedVolume_ = [bySpace, relative, present = problem.present](const VectorXd& x) {
      return relative + bySpace.dot(x - present);
    };
    result.hasVolume =
        design_.volume == Design::Volume::kKept || design_.volume == Design::Volume::kNotLarger;
    if (design_.volume == Design::Volume::kKept)
      problem.rows.push_back({bySpace, relative, 1, kLimitWeight, false});
    if (design_.volume == Design::Volume::kNotLarger)
      problem.rows.push_back({-bySpace, -relative, -1, kLimitWeight, true});
    if (minimisesVolume() && bySpace.cwiseAbs().maxCoeff() > 0)
      problem.push = kVolumePush / bySpace.cwiseAbs().maxCoeff() * bySpace;
    addWalls(state, result);
    return result;
  }

  /// Rows of the walls that the variables could make too thin, the thinnest of them.
  void addWalls(const SearchState& state, SearchRows& result) const {
    struct Thin {
      const WallThickness* wall;
      double left;
    };
    std::vector<Thin> thin;
    for (const WallThickness& wall : state.walls) {
      const double least = evaluator_.leastThickness(wall);
      if (least > 0 && wall.value < least + 4 * space_.limit())
        thin.push_back({&wall, wall.value / least});
    }
    std::sort(thin.begin(), thin.end(),
              [](const Thin& a, const Thin& b) { return a.left < b.left; });
    if (thin.size() > kMaxWalls) thin.resize(kMaxWalls);
    const auto& solid = std::get<modeling::Solid>(state.project.body);
    for (const Thin& each : thin) {
      const double least = evaluator_.leastThickness(*each.wall);
      result.problem.rows.push_back({slopeOf(each.wall->gradient(solid), least), each.left,
                                     1 + kThicknessMargin, kLimitWeight, true});
      result.walls.push_back(*each.wall);
    }
  }

  /// The shape at x, or none if it folds or cannot be solved.
  std::optional<SearchState> tryShape(const VectorXd& x, std::string& refusal) {
    ++shapes_;
    report(shapes_);
    try {
      return evaluator_.at(space_.limit() * x, quiet_);
    } catch (const modeling::ModelingError& error) {
      if (error.kind() == modeling::ModelingError::Kind::kTooLarge) throw;
      refusal = error.what();
    } catch (const bem::SolverError& error) {
      if (error.kind() == bem::SolverError::Kind::kTooLarge) throw;
      refusal = error.what();
    }
    ShapeStep step;
    step.number = shapes_;
    step.isAccepted = false;
    step.problem = refusal;
    add(std::move(step));
    return std::nullopt;
  }

  ShapeStep stepOf(const SearchState& state, bool isAccepted) const {
    ShapeStep step{shapes_, isAccepted, state.values, state.volume, {}, state.largestMovement, {}};
    for (const WallThickness& wall : state.walls)
      step.thinnest = std::min(step.thinnest.value_or(wall.value), wall.value);
    return step;
  }

  void record(const SearchState& state, bool isAccepted) { add(stepOf(state, isAccepted)); }

  void add(ShapeStep step) {
    steps_.push_back(std::move(step));
    if (options_.onStep) options_.onStep(steps_.back());
  }

  void report(int shape) const {
    job_.report(Phase::kSearch, static_cast<double>(shape) / (design_.steps + 1));
  }

  ShapeResult resultOf(SearchState& best, const SearchRows& rows, SearchTroubles troubles) {
    ShapeResult result;
    result.isReached = isMet(best);
    troubles.hasStepsLeft = shapes_ < design_.steps;
    if (!result.isReached) result.limits = findLimits(rows, design_, space_, troubles);
    for (const ShapeStep& step : steps_)
      if (step.isAccepted && step.values == best.values) result.final = step;
    const auto& from = space_.solid().controlPoints();
    const auto& to = std::get<modeling::Solid>(best.project.body).controlPoints();
    for (std::size_t i = 0; i < from.size(); ++i) result.movedPoints += from[i] != to[i];
    result.project = std::move(best.project);
    result.commands = std::move(best.commands);
    result.steps = std::move(steps_);
    job_.report(Phase::kSearch, 1);
    return result;
  }

  const Design& design_;
  const ShapeSearchOptions& options_;
  const Job& job_;
  Job quiet_;
  DesignSpace space_;
  ShapeEvaluator evaluator_;
  double largestWeight_ = 0, firstVolume_ = 1;
  std::function<double(const VectorXd&)> expectedVolume_;
  int shapes_ = 0;
  std::vector<ShapeStep> steps_;
};

}  // namespace

const char* nameOf(ShapeLimit::Kind kind) {
  switch (kind) {
    case ShapeLimit::Kind::kMovement:
      return "movement";
    case ShapeLimit::Kind::kThickness:
      return "thickness";
    case ShapeLimit::Kind::kVolume:
      return "volume";
    case ShapeLimit::Kind::kFolding:
      return "folding";
    case ShapeLimit::Kind::kElements:
      return "elements";
    case ShapeLimit::Kind::kSteps:
      return "steps";
    case ShapeLimit::Kind::kPoints:
      return "points";
    case ShapeLimit::Kind::kTargets:
      break;
  }
  return "targets";
}

void validateDesign(const modeling::Project& project, const Design& design) {
  modeling::requireSolid(project);
  std::vector<std::string> touches;
  for (const modeling::Touch& touch : project.touches) touches.push_back(touch.name);
  modeling::checkDesign(design, touches, "design");
  if (design.targets.empty())
    throw modeling::ModelingError(
        "design.targets: there is no target; state the stiffness or force of a touch");
  for (std::size_t i = 0; i < design.targets.size(); ++i) {
    const DesignTarget& target = design.targets[i];
    if (target.kind != DesignTarget::Kind::kForce) continue;
    const std::string path = "design.targets[" + std::to_string(i) + "].";
    const auto touch =
        std::find_if(project.touches.begin(), project.touches.end(),
                     [&](const modeling::Touch& each) { return each.name == target.touch; });
    if (modeling::infoOf(touch->kind).isForce)
      throw modeling::ModelingError(path + "force_N: the touch \"" + target.touch +
                                    "\" states its force; give a stiffness");
    if (target.depth && touch->vector.isZero(0))
      throw modeling::ModelingError(path + "depth_mm: the touch \"" + target.touch +
                                    "\" has no displacement, so that the depth has no direction");
  }
}

ShapeResult findShape(const modeling::Project& project, const Design& design,
                      const ShapeSearchOptions& options, const Job& job) {
  validateDesign(project, design);
  return Search(project, design, options, job).run();
}

void applyShape(const ShapeResult& result, modeling::Document& document) {
  if (result.commands.empty()) return;
  document.beginGroup("Find a shape");
  try {
    for (const modeling::Command& command : result.commands) document.perform(command);
  } catch (...) {
    document.cancelGroup();
    throw;
  }
  document.endGroup();
}

}  // namespace palpa::app
