#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <string>

namespace palpa::bem {

/// "(0, 12.5, -3) mm", four digits, for messages. What is only rounding beside the largest
/// coordinate reads as 0.
inline std::string placeText(const Eigen::Vector3d& place) {
  const double noise = 1e-9 * place.cwiseAbs().maxCoeff();
  const auto shown = [&](int k) { return std::abs(place[k]) <= noise ? 0.0 : place[k]; };
  char text[80];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) mm", shown(0), shown(1), shown(2));
  return text;
}

}  // namespace palpa::bem
