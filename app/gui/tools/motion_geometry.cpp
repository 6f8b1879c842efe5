#include "app/gui/tools/motion_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::gui {

double degreesAround(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to) {
  const Eigen::Vector2d a = from - centre;
  const Eigen::Vector2d b = to - centre;
  // y grows downwards: the cross product has the opposite sign.
  return -std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180.0 / std::numbers::pi;
}

double factorFrom(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to, double least) {
  const Eigen::Vector2d arm = from - centre;
  const double factor = arm.norm() < least ? 1.0 + (to.x() - from.x()) / 100.0
                                           : arm.dot(to - centre) / arm.squaredNorm();
  return std::max(0.0, factor);
}

double snapped(double value, double step) {
  return std::round(value / step) * step;
}

Eigen::Vector3d nearestAxis(const Eigen::Vector3d& direction, int except) {
  int best = -1;
  for (int i = 0; i < 3; ++i)
    if (i != except && (best < 0 || std::abs(direction[i]) > std::abs(direction[best]) + 1e-9))
      best = i;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis[best] = direction[best] < 0 ? -1 : 1;
  return axis;
}

double roundLengthBelow(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length) + 1e-9));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= length * (1 + 1e-9)) return digit * power;
  return power;
}

}  // namespace palpa::gui
