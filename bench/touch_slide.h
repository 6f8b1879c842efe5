#pragma once

#include <memory>
#include <vector>

#include "app/core/live/touchable_model.h"

namespace palpa::bench {

/// A tool dragged once around the sphere R = 25 mm at constant depth, on a great circle that is
/// tilted by 30 degrees, at 100 mm/s with a step every millisecond.
struct Slide {
  struct Sample {
    double angle = 0;  ///< rad
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    double seconds = 0;  ///< of the step
    bool isConverged = true;
    int patches = 0;
    double radius = 0;  ///< of the first mask, mm
  };
  static constexpr std::size_t kOnset = 50;
  std::vector<Sample> samples;

  double largestForce() const;
  /// Largest change of the force between two samples, N, after the first 5 mm, in which friction
  /// builds up. The direction turns by 0.2 degrees per step, which accounts for 0.4 % of the force.
  double largestJump() const;
  double largestMagnitudeJump() const;
  /// Largest change of the magnitude's slope between pairs of samples, N.
  double largestKink() const;
};

/// Columns are computed beforehand and not timed.
Slide dragAround(const std::shared_ptr<const app::TouchableModel>& model,
                 const bem::ContactTool& tool, double depth);

}  // namespace palpa::bench
