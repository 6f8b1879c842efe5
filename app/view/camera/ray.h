#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "app/view/scene/scene.h"

/// Lines of sight. Internal to app/view; pure arithmetic, no VTK.
namespace palpa::view {

/// All points origin + s direction, s > 0.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit

  Eigen::Vector3d at(double s) const { return origin + s * direction; }
};

struct RayHit {
  int triangle = -1;
  double distance = 0;  ///< from the ray's origin
};

/// Where the ray meets the triangle, from either side. Time: 20 ns.
std::optional<double> distanceTo(const Ray& ray, const std::vector<Eigen::Vector3d>& positions,
                                 const Triangle& triangle);

/// The s of the point `through` + s `direction` (any length but zero) nearest to the ray's line;
/// nothing when the two are parallel to within 1 degree.
std::optional<double> nearestOnLine(const Ray& ray, const Eigen::Vector3d& through,
                                    const Eigen::Vector3d& direction);

}  // namespace palpa::view
