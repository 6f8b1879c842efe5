#pragma once

#include <cstddef>
#include <vector>

#include "app/core/design/search_limits.h"
#include "app/core/design/search_state.h"
#include "modeling/project/design.h"

namespace palpa::app {

/// What a search makes small: squared misses of the targets in logarithms, violations of limits
/// and, if the design asks for it, the volume. The design and the evaluator must outlive it.
class SearchMerit {
 public:
  /// Largest relative violations of limits that are rounding of the search.
  static constexpr double kLimitTolerance = 1e-3;
  /// Thicknesses aim higher by this part, so that the curvature of their change does not violate
  /// them.
  static constexpr double kThicknessMargin = 2e-3;
  /// Share of the volume if it is to be small.
  static constexpr double kVolumeShare = 0.02;

  /// `start`: the shape at which the search begins.
  SearchMerit(const modeling::Design& design, const ShapeEvaluator& evaluator,
              const SearchState& start);

  bool minimisesVolume() const { return design_.volume == modeling::Design::Volume::kMinimised; }
  /// Volume of the start, mm^3.
  double firstVolume() const { return firstVolume_; }
  /// Weight of a target over the largest one.
  double weightOf(std::size_t target) const;
  /// Logarithm of a value of a target over the wanted one.
  double miss(const std::vector<double>& values, std::size_t target) const;

  double of(const SearchState& state) const;
  /// What the rows of a shape promise for a step.
  double expected(const SearchRows& rows, const StepSolution& step) const;
  /// Largest part by which a target misses what a small step promised, if that is more than the
  /// step itself: there the values jump.
  double jumpAt(const SearchState& state, const SearchRows& rows, const StepSolution& step) const;

  bool keepsLimits(const SearchState& state) const;
  /// True if all targets are met and all limits are kept.
  bool isMet(const SearchState& state) const;
  bool isBetter(const SearchState& state, const SearchState& than) const;

 private:
  struct Parts {
    double misfit = 0;     ///< Σ weight ln²(value / target)
    double violation = 0;  ///< of the volume and thicknesses, relative, the largest
    double volume = 1;     ///< over the first one
  };
  double combined(const Parts& parts) const;
  double volumeViolation(double relative) const;
  double violationOf(const SearchState& state) const;

  const modeling::Design& design_;
  const ShapeEvaluator& evaluator_;
  double firstVolume_, largestWeight_ = 0;
};

}  // namespace palpa::app
