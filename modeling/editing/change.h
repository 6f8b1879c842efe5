#pragma once

#include <vector>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// Differences between two states of a project, which determine the parts to draw or compute again.
struct Change {
  std::vector<int> movedPoints;     ///< control points with another position, ascending
  std::vector<int> changedPatches;  ///< patches with moved control points, ascending
  /// Patches, degrees, knots, nets or the number of points differ (or any part of a mesh body): all
  /// data derived from the body are invalid, and the two lists above are empty.
  bool topology = false;
  bool edges = false;       ///< smooth edges
  bool patchNames = false;  ///< if the patches are otherwise equal
  bool primitive = false;
  bool name = false;
  bool material = false;
  bool supports = false;
  bool loads = false;
  bool touches = false;
  bool measurements = false;
  bool design = false;
  bool mesh = false;
  bool view = false;

  bool body() const { return topology || edges || patchNames || !movedPoints.empty(); }
  bool any() const {
    return body() || primitive || name || material || supports || loads || touches ||
           measurements || design || mesh || view;
  }
};

/// Compares all values of two projects, numbers exactly. Cost: some microseconds per hundred
/// control points.
Change compare(const Project& before, const Project& after);

}  // namespace palpa::modeling
