#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace palpa::app {

/// A point of a surface.
struct OrientedPoint {
  Eigen::Vector3d position;  ///< mm
  Eigen::Vector3d normal;    ///< unit
};

/// Distance that also tells the two sides of a thin part and of a sharp edge apart: opposite
/// normals are `scale` * 2 (mm) away from each other.
double orientedDistance(const OrientedPoint& a, const OrientedPoint& b, double scale);

/// Chooses up to `count` of the points, evenly spread: each next one is the farthest from all
/// before. Indices into `points`.
std::vector<int> spreadPlaces(std::span<const OrientedPoint> points, int count, double scale);

}  // namespace palpa::app
