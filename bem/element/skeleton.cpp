#include "bem/element/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bem/element/kelvin_blocks.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

/// Distance of distant sources from the centre of a cluster of points over its radius.
constexpr double kFarRatio = 1.5;
/// Forces on the sphere of this ratio: half a radius of the cluster apart. Measured: products have
/// relative errors of 1e-5 for a tolerance of 1e-5, 4e-5 for 1e-4.
constexpr int kForcesOnSphere = 128;

/// Even points on the unit sphere, on a spiral.
std::vector<Vector3d> spiral(int count) {
  std::vector<Vector3d> points;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, radius = std::sqrt(1 - z * z);
    points.emplace_back(radius * std::cos(turn * k), radius * std::sin(turn * k), z);
  }
  return points;
}

}  // namespace

void setForce(const KelvinConstants& constants, const Vector3d& x, const Vector3d& y, int i,
              double factor, float* to) {
  const Vector3d r = y - x;
  const double inverse = 1 / r.norm(), cubed = inverse * inverse * inverse;
  for (int c = 0; c < 3; ++c)
    to[c] =
        static_cast<float>(factor * constants.weightU *
                           (r[i] * r[c] * cubed + (i == c ? constants.diagonalU * inverse : 0)));
}

void setDislocation(const KelvinConstants& constants, const Vector3d& x, const Vector3d& y,
                    const Vector3d& n, int i, double factor, float* to) {
  const Vector3d r = y - x;
  const double inverse = 1 / r.norm(), cubed = inverse * inverse * inverse,
               fifth = cubed * inverse * inverse * r.dot(n);
  const Vector3d turn = cubed * r.cross(n);
  const double sums[kKernelSumsT] = {fifth * r[0] * r[0],
                                     fifth * r[0] * r[1],
                                     fifth * r[1] * r[1],
                                     fifth * r[0] * r[2],
                                     fifth * r[1] * r[2],
                                     fifth * r[2] * r[2],
                                     turn[0],
                                     turn[1],
                                     turn[2]};
  for (int c = 0; c < 3; ++c)
    to[c] = static_cast<float>(factor * detail::BlockT::component(constants, sums, i, c));
}

bool isDistant(const Ball& points, const Ball& sources) {
  const double distance = (points.centre - sources.centre).norm() - sources.radius;
  // A few points on one place have no radius.
  return distance >= kFarRatio * std::max(points.radius, 0.1 * sources.radius);
}

RowChoice chooseSkeleton(const KelvinConstants& constants, std::span<const Vector3d> points,
                         std::span<const int> rows, const Ball& ball, double tolerance) {
  static const std::vector<Vector3d> directions = spiral(kForcesOnSphere);
  // The choice does not depend on the unit of the fields; single precision needs a scale.
  const double scale = 1 / constants.weightU;
  RowMatrixXf fields(static_cast<Index>(rows.size()), 3 * kForcesOnSphere);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int q = 0; q < kForcesOnSphere; ++q)
      setForce(constants, points[static_cast<std::size_t>(rows[k] / 3)],
               ball.centre + kFarRatio * ball.radius * directions[static_cast<std::size_t>(q)],
               rows[k] % 3, scale, fields.row(static_cast<Index>(k)).data() + 3 * q);
  return chooseRows(std::move(fields), static_cast<float>(tolerance));
}

}  // namespace palpa::bem
