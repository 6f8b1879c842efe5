#pragma once

#include "app/view/scene/scene.h"

namespace palpa::render_tests {

/// A triangulated surface: every shape below is closed and oriented outward.
struct Shape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<view::Triangle> triangles;
};

/// Six n × n grids pushed onto the sphere about the origin.
Shape sphere(double radius, int n);

/// Axis-aligned, centred in x and y, base at z = 0; n × n grids on each face.
Shape box(const Eigen::Vector3d& size, int n);

}  // namespace palpa::render_tests
