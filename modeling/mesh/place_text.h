#pragma once

#include <Eigen/Core>
#include <cstdio>
#include <string>

namespace palpa::modeling {

/// Four significant digits, for sentences about places and sizes.
inline std::string roundedText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// "(1.5, -2, 30) mm"
inline std::string placeText(const Eigen::Vector3d& x) {
  return "(" + roundedText(x.x()) + ", " + roundedText(x.y()) + ", " + roundedText(x.z()) + ") mm";
}

}  // namespace palpa::modeling
