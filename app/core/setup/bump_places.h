#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {

/// A place on a patch near the centre of a bump.
struct BumpPlace {
  int patch;
  std::array<double, 2> parameters;
  double radius;  ///< of the bump, mm
};

/// Samples of a grid within half of a bump's radius, where most of its load acts.
std::vector<BumpPlace> placesUnder(const modeling::SurfaceEvaluator& surface,
                                   const Eigen::Vector3d& center, double radius);

}  // namespace palpa::app
