#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palpa::app {

/// Weights for interpolating what is known at touch places; they sum to 1. Functions that are
/// linear in space, such as rigid motions, are reproduced up to a small part. At a place its own
/// weight is 1.
struct PlaceWeights {
  static constexpr std::size_t kCount = 8;
  std::array<std::uint16_t, kCount> places{};
  std::array<float, kCount> weights{};
};

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

/// Weights of `places` at a point: moving least squares of a linear function through the nearest
/// places. The weight function falls to zero at the first place that is not used, so that the
/// weights change continuously along the surface.
PlaceWeights weightsAt(const OrientedPoint& point, std::span<const OrientedPoint> places,
                       double scale);

}  // namespace palpa::app
