#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>

namespace palpa::modeling {

/// Face of the cube [-1, 1]³ with the axes of its parameters; u × v points outwards.
struct CubeFace {
  const char* name;
  Eigen::Vector3d normal, u, v;

  bool isSide() const { return normal.z() == 0.0; }
};

/// Faces of the cube: the four sides, the bottom, the top.
inline const std::array<CubeFace, 6>& cubeFaces() {
  static const std::array<CubeFace, 6> faces{{
      {"side_xmin", {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
      {"side_xmax", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {"side_ymin", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
      {"side_ymax", {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
      {"bottom", {0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
      {"top", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
  }};
  return faces;
}

/// Angle from -π/4 to π/4 for a parameter from 0 to 1; exactly odd about 0.5.
inline double quarterAngle(double t) {
  return (t - 0.5) * 2.0 * (std::numbers::pi / 4);
}

}  // namespace palpa::modeling
