#pragma once

#include <functional>

#include "app/view/scene.h"

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

/// Axis z, base at z = 0; points of caps and side are shared along the rims.
Shape cylinder(double radius, double height, int around, int along);

/// Indices of triangles whose corners all satisfy `inside`.
std::vector<int> trianglesWhere(const Shape& shape,
                                const std::function<bool(const Eigen::Vector3d&)>& inside);

/// direction · peak · (1 - (distance/radius)²)² within `radius` of `center`, zero outside.
std::vector<Eigen::Vector3d> bump(const Shape& shape, const Eigen::Vector3d& center, double radius,
                                  const Eigen::Vector3d& peak);

std::vector<double> norms(const std::vector<Eigen::Vector3d>& vectors);

}  // namespace palpa::render_tests
