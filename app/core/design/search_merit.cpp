#include "app/core/design/search_merit.h"

#include <algorithm>
#include <cmath>

namespace palpa::app {
namespace {

using modeling::Design;

/// Share of limits, per squared relative violation.
constexpr double kViolationShare = 100.0;

}  // namespace

SearchMerit::SearchMerit(const Design& design, const ShapeEvaluator& evaluator,
                         const SearchState& start)
    : design_(design), evaluator_(evaluator), firstVolume_(start.volume) {
  for (const modeling::DesignTarget& target : design.targets)
    largestWeight_ = std::max(largestWeight_, target.weight);
}

double SearchMerit::weightOf(std::size_t target) const {
  return design_.targets[target].weight / largestWeight_;
}

double SearchMerit::miss(const std::vector<double>& values, std::size_t target) const {
  return std::log(values[target] / design_.targets[target].value);
}

double SearchMerit::combined(const Parts& parts) const {
  return parts.misfit + kViolationShare * parts.violation * parts.violation +
         (minimisesVolume() ? kVolumeShare * parts.volume : 0);
}

double SearchMerit::volumeViolation(double relative) const {
  if (design_.volume == Design::Volume::kKept) return std::abs(relative - 1);
  if (design_.volume == Design::Volume::kNotLarger) return std::max(0.0, relative - 1);
  return 0;
}

double SearchMerit::violationOf(const SearchState& state) const {
  double violation = volumeViolation(state.volume / firstVolume_);
  for (const WallThickness& wall : state.walls)
    if (const double least = evaluator_.leastThickness(wall); least > 0)
      violation = std::max(violation, 1 - wall.value / least);
  return violation;
}

double SearchMerit::of(const SearchState& state) const {
  Parts parts{0, violationOf(state), state.volume / firstVolume_};
  for (std::size_t i = 0; i < design_.targets.size(); ++i)
    parts.misfit += weightOf(i) * std::pow(miss(state.values, i), 2);
  return combined(parts);
}

double SearchMerit::expected(const SearchRows& rows, const StepSolution& step) const {
  const std::vector<StepProblem::Row>& all = rows.problem.rows;
  Parts parts;
  parts.volume = rows.volume + rows.volumeSlope.dot(step.x - rows.problem.present);
  for (std::size_t i = 0; i < rows.targets; ++i)
    parts.misfit += weightOf(i) * std::pow(all[i].goal - step.values[i], 2);
  parts.violation = volumeViolation(parts.volume);
  for (std::size_t k = all.size() - rows.walls.size(); k < all.size(); ++k)
    parts.violation =
        std::max(parts.violation, all[k].goal / (1 + kThicknessMargin) - step.values[k]);
  return combined(parts);
}

double SearchMerit::jumpAt(const SearchState& state, const SearchRows& rows,
                           const StepSolution& step) const {
  double jump = 0;
  for (std::size_t i = 0; i < rows.targets; ++i) {
    const double missed = std::abs(miss(state.values, i) - step.values[i]);
    if (missed > design_.tolerance &&
        missed > std::abs(step.values[i] - rows.problem.rows[i].value))
      jump = std::max(jump, missed);
  }
  return jump;
}

bool SearchMerit::keepsLimits(const SearchState& state) const {
  return violationOf(state) <= kLimitTolerance;
}

bool SearchMerit::isMet(const SearchState& state) const {
  for (std::size_t i = 0; i < design_.targets.size(); ++i)
    if (std::abs(state.values[i] / design_.targets[i].value - 1) > design_.tolerance) return false;
  return keepsLimits(state);
}

bool SearchMerit::isBetter(const SearchState& state, const SearchState& than) const {
  if (!keepsLimits(state)) return false;
  if (isMet(state) != isMet(than)) return isMet(state);
  return of(state) < of(than);
}

}  // namespace palpa::app
