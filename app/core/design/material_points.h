#pragma once

#include <Eigen/Dense>
#include <vector>

#include "modeling/project/project.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::app {

/// Points of a solid's surface that move along with the material: V = Σ_j N_j dP_j. Beside the
/// border of a support that is a half space, which stays in space, they slide along the surface
/// instead, so that the support keeps its border. Const use from several threads is safe.
class MaterialPoints {
 public:
  /// `slideWidth`: mm, how far from a border points slide; 0: only on the border itself.
  MaterialPoints(const modeling::Project& project, const modeling::Solid& solid,
                 const std::vector<modeling::SurfaceParameter>& places, double slideWidth);

  /// Derivative by the control points from the derivative by the points, one column each.
  Eigen::Matrix3Xd byControlPoints(const Eigen::Matrix3Xd& byPoints) const;

 private:
  struct Weight {
    int controlPoint;
    double value;
  };
  struct Slide {
    int point;
    Eigen::Matrix3d motion;  ///< V of the point from V of the material
  };
  int controlPoints_;
  std::vector<std::size_t> first_{0};
  std::vector<Weight> weights_;
  std::vector<Slide> slides_;
};

}  // namespace palpa::app
