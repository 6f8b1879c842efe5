#pragma once

#include <vector>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// What differs between two states of a project: what has to be drawn or computed again.
struct Change {
  std::vector<int> movedPoints;     ///< control points with another position, ascending
  std::vector<int> changedPatches;  ///< patches that use one of them, ascending
  /// Patches, degrees, knots, nets or the number of points differ (or any part of a mesh body):
  /// everything made from the body must be made anew; the two lists above are then empty.
  bool topology = false;
  bool edges = false;       ///< which edges are smooth
  bool patchNames = false;  ///< with the same patches otherwise
  bool primitive = false;
  bool name = false;
  bool material = false;
  bool supports = false;
  bool loads = false;
  bool touches = false;
  bool mesh = false;
  bool view = false;

  bool body() const { return topology || edges || patchNames || !movedPoints.empty(); }
  bool any() const {
    return body() || primitive || name || material || supports || loads || touches || mesh || view;
  }
};

/// Compares everything a project file holds, numbers exactly. Cost: some microseconds per hundred
/// control points.
Change compare(const Project& before, const Project& after);

}  // namespace palpa::modeling
