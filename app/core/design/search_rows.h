#pragma once

#include "app/core/design/search_limits.h"
#include "app/core/design/search_merit.h"
#include "app/core/design/search_state.h"

namespace palpa::app {

/// The subproblem at a shape: derivatives of the targets, of the volume and of walls that a step
/// could make too thin. Costs one factorisation's share and one solution per target. Throws as
/// StiffnessGradients.
SearchRows rowsAt(const SearchState& state, const modeling::Design& design,
                  const DesignSpace& space, const ShapeEvaluator& evaluator,
                  const SearchMerit& merit, const Job& job);

}  // namespace palpa::app
