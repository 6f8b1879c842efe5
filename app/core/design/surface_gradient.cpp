#include "app/core/design/surface_gradient.h"

#include <algorithm>
#include <cmath>

#include "app/core/design/shape_measures.h"
#include "app/core/setup/to_spline_surface.h"
#include "base/round_number.h"
#include "modeling/solid/basis.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr double kCovered = 0.97;  // of the points
constexpr double kMm3PerCm3 = 1000;
/// Smallest change of the volume along a normal, over the change along the control point's mean
/// normal: a point on a thin rim has surfaces that face each other, whose changes cancel.
constexpr double kMinVolumeShare = 0.25;

}  // namespace

SurfaceGradient::SurfaceGradient(const DesignSurface& surface, const DrawnBody& drawn)
    : normals_(drawn.mesh().normals) {
  const modeling::Solid& solid = surface.basis.solid();
  const Eigen::Matrix3Xd ofVolume = volumeOf(surface).gradient;
  const auto triangles =
      splineTriangles(solid, modeling::SurfaceEvaluator(solid), drawn.model().surface());
  for (std::size_t k = 0; k < drawn.mesh().links.size(); ++k) {
    const modeling::DisplayMesh::Link& link = drawn.mesh().links[k];
    const auto& triangle = triangles[static_cast<std::size_t>(link.triangle)];
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (int corner = 0; corner < 3; ++corner)
      at += link.weights[corner] * triangle.corners[static_cast<std::size_t>(corner)];
    const modeling::Patch& patch = solid.patches()[static_cast<std::size_t>(triangle.patch)];
    for (int direction = 0; direction < 2; ++direction) {
      const auto [low, high] = patch.range(direction);
      at[direction] = std::clamp(at[direction], low, high);
    }
    const auto u = modeling::basisAt(patch.knots[0], patch.degree[0], at[0]);
    const auto v = modeling::basisAt(patch.knots[1], patch.degree[1], at[1]);
    for (int i = 0; i <= patch.degree[0]; ++i)
      for (int j = 0; j <= patch.degree[1]; ++j) {
        const double value = u.value[i] * v.value[j];
        if (value == 0) continue;
        const int point = patch.net[u.first + i][v.first + j];
        const Vector3d volume = ofVolume.col(point);
        const double along = std::max(volume.dot(normals_[k]), kMinVolumeShare * volume.norm());
        if (along > 0) weights_.push_back({point, value / along});
      }
    first_.push_back(weights_.size());
  }
}

std::vector<double> SurfaceGradient::values(const Eigen::Matrix3Xd& gradient) const {
  std::vector<double> values(normals_.size(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (std::size_t w = first_[k]; w < first_[k + 1]; ++w)
      values[k] += weights_[w].value * gradient.col(weights_[w].controlPoint).dot(normals_[k]);
    values[k] *= kMm3PerCm3;
  }
  return values;
}

double surfaceGradientEnd(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double value : values)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 1;
  const auto end =
      sizes.begin() + static_cast<std::ptrdiff_t>(kCovered * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), end, sizes.end());
  return *end > 0 ? roundedUp(*end) : 1;
}

}  // namespace palpa::app
