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
    double seconds = 0;  ///< that the step took
    bool isConverged = true;
    int patches = 0;
    double radius = 0;  ///< of the first mask, mm
  };
  static constexpr std::size_t kOnset = 50;
  std::vector<Sample> samples;

  double largestForce() const;
  /// Of the force between two samples, N, once the tool is on its way: in the first 5 mm friction
  /// builds up. Of it 0.4 % are due to the direction that turns by 0.2 degrees.
  double largestJump() const;
  double largestMagnitudeJump() const;
  /// Of the magnitude's change from one pair of samples to the next, N: where its slope breaks.
  double largestKink() const;
};

/// Columns are computed before they are needed and not timed.
Slide dragAround(const std::shared_ptr<const app::TouchableModel>& body,
                 const bem::ContactTool& tool, double depth);

}  // namespace palpa::bench
