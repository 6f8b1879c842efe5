#include "app/core/design/shape_search.h"

#include <algorithm>
#include <cmath>

#include "app/core/design/search_limits.h"
#include "app/core/design/search_merit.h"
#include "app/core/design/search_rows.h"
#include "app/core/design/search_state.h"
#include "app/core/design/step_problem.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"

namespace palpa::app {
namespace {

using Eigen::VectorXd;
using modeling::Design;
using modeling::DesignTarget;

/// Steps shorter than this (in parts of the limit) should do what the rows promise.
constexpr double kSmallStep = 0.1;
constexpr double kFirstRadius = 0.5, kMinRadius = 1e-3;

class Search {
 public:
  Search(const modeling::Project& project, const Design& design, const ShapeSearchOptions& options,
         const Job& job)
      : design_(design),
        options_(options),
        job_(job),
        quiet_{job.stop, {}, job.threads},
        space_(project, design),
        evaluator_(project, design, space_, options.build) {}

  ShapeResult run() {
    report(0);
    SearchState current = evaluator_.at(VectorXd::Zero(space_.variableCount()), quiet_);
    evaluator_.learnThicknesses(current);
    const SearchMerit merit(design_, evaluator_, current);
    record(current, true);
    SearchState best = current;
    bool isReached = merit.isMet(current);
    SearchTroubles troubles;
    double radius = kFirstRadius;
    int slow = 0;
    SearchRows rows;
    while (!isReached || merit.minimisesVolume()) {
      rows = rowsAt(current, design_, space_, evaluator_, merit, quiet_);
      bool isAccepted = false;
      while (!isAccepted && radius >= kMinRadius && shapes_ < design_.steps) {
        rows.problem.radius = radius;
        const StepSolution step = solveStep(rows.problem);
        const double before = merit.of(current), expected = merit.expected(rows, step);
        const double length = (step.x - rows.problem.present).cwiseAbs().maxCoeff();
        if (before - expected < 1e-3 * std::min(before, SearchMerit::kVolumeShare)) break;
        std::optional<SearchState> next = tryShape(step.x, troubles.refusal);
        if (!next) {
          radius = length / 4;
          continue;
        }
        const double gain = (before - merit.of(*next)) / (before - expected);
        isAccepted = gain > 0.1 || (!isReached && merit.isMet(*next));
        record(*next, isAccepted);
        if (!isAccepted && length < kSmallStep) {
          troubles.jump = std::max(troubles.jump, merit.jumpAt(*next, rows, step));
          for (const WallThickness& wall : next->walls)
            if (wall.value < (1 - SearchMerit::kLimitTolerance) * evaluator_.leastThickness(wall))
              troubles.thinPatch = wall.patch;
        }
        if (gain < 0.5) radius = std::max(length, kMinRadius) * (gain < 0.1 ? 0.25 : 0.5);
        if (gain > 0.75 && length > 0.9 * radius) radius = std::min(2 * radius, 2.0);
        if (!isAccepted) continue;
        slow = before - merit.of(*next) < 0.02 * before ? slow + 1 : 0;
        troubles.refusal.clear();
        current = std::move(*next);
      }
      if (!isAccepted) break;
      if (merit.isBetter(current, best)) best = current;
      isReached = isReached || merit.isMet(current);
      if (slow >= 3 || shapes_ >= design_.steps) break;
    }
    return resultOf(best, merit.isMet(best), rows, troubles);
  }

 private:
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
    step.solid =
        std::make_shared<const modeling::Solid>(std::get<modeling::Solid>(state.project.body));
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

  ShapeResult resultOf(SearchState& best, bool isReached, const SearchRows& rows,
                       SearchTroubles troubles) {
    ShapeResult result;
    result.isReached = isReached;
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
