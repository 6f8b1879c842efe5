#pragma once

#include <string>
#include <vector>

#include "app/core/design/search_state.h"
#include "app/core/design/shape_search.h"
#include "app/core/design/step_problem.h"

namespace palpa::app {

/// Rows of the subproblem at a shape, in this order: targets (logarithms of the values), the volume
/// if it is limited, then walls that a step could make too thin.
struct SearchRows {
  StepProblem problem;  ///< in parts of DesignSpace::limit()
  std::size_t targets = 0;
  bool hasVolume = false;
  /// Volume over the volume at the start, and its slope by the variables in parts of their limit.
  double volume = 1;
  Eigen::VectorXd volumeSlope{};
  std::vector<WallThickness> walls;
};

/// What the last steps ran into.
struct SearchTroubles {
  std::string refusal;  ///< message of the last shape that could not be computed; empty for none
  double jump = 0;      ///< relative, of a computed value in a small step; 0 for none
  int thinPatch = -1;   ///< patch with a wall that a small step made too thin; -1 for none
  bool hasStepsLeft = true;
};

/// Why the search ended: what the last steps ran into, and what the subproblem without a trust
/// region runs into. Never empty.
std::vector<ShapeLimit> findLimits(SearchRows rows, const modeling::Design& design,
                                   const DesignSpace& space, const SearchTroubles& troubles);

}  // namespace palpa::app
