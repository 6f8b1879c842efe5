#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "app/view/viewport/picture.h"

namespace palpa::report {

/// Colours, arrow lengths and camera that several pictures have in common, so that they can be
/// compared: of a film, of two variants. The camera is from the picture with the largest force.
class CommonView {
 public:
  /// Every picture, first.
  void add(const view::Picture& picture);
  /// To be called once, after all.
  void finish();
  /// To every picture then.
  void applyTo(view::Picture& picture) const;

 private:
  static constexpr int kDirections = 26;
  static const std::array<Eigen::Vector3d, kDirections>& directions();
  void reach(const Eigen::Vector3d& point);

  std::array<double, 2> range_{std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
  view::LiveArrows arrows_;  // of all pictures
  std::array<Eigen::Vector3d, kDirections> extremes_;
  bool isAny_ = false;
  double fullForce_ = 0;   // N
  double fullLength_ = 0;  // mm
  view::CameraView camera_;
};

}  // namespace palpa::report
