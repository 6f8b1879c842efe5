#include "app/core/design/material_points.h"

#include <algorithm>
#include <cmath>

#include "modeling/solid/basis.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Distance from a border within which a point lies on it, over the size of the body.
constexpr double kOnBorder = 1e-7;
/// Sine of the angle between plane and surface below which points do not slide.
constexpr double kMinSine = 0.05;

/// Motion of a point near the plane from the motion of the material: V − ζ τ (m·V) / (m·τ), with
/// the normal m of the plane, the direction τ along the surface away from it, and ζ = 1 at the
/// border.
Matrix3d slide(const Vector3d& normal, const Vector3d& surface, double share) {
  const Vector3d m = normal.normalized(), along = m - m.dot(surface) * surface;
  const double sine = along.norm();
  if (sine < kMinSine) return Matrix3d::Identity();
  return Matrix3d::Identity() - share / (sine * sine) * along * m.transpose();
}

}  // namespace

MaterialPoints::MaterialPoints(const modeling::Project& project, const modeling::Solid& solid,
                               const std::vector<modeling::SurfaceParameter>& places,
                               double slideWidth)
    : controlPoints_(static_cast<int>(solid.controlPoints().size())) {
  const modeling::SurfaceEvaluator evaluator(solid);
  const auto [low, high] = modeling::boundingBox(project.body);
  const double reach = std::max(slideWidth, kOnBorder * (high - low).norm());
  for (const modeling::SurfaceParameter& at : places) {
    const modeling::Patch& patch = solid.patches()[at.patch];
    const auto u = modeling::basisAt(patch.knots[0], patch.degree[0], at.u);
    const auto v = modeling::basisAt(patch.knots[1], patch.degree[1], at.v);
    for (int i = 0; i <= patch.degree[0]; ++i)
      for (int j = 0; j <= patch.degree[1]; ++j)
        weights_.push_back({patch.net[u.first + i][v.first + j], u.value[i] * v.value[j]});
    const int point = static_cast<int>(first_.size()) - 1;
    first_.push_back(weights_.size());
    for (const modeling::Support& support : project.supports)
      for (const modeling::RegionPart& part : support.where.parts)
        if (const auto* plane = std::get_if<modeling::HalfSpace>(&part)) {
          const double distance =
              plane->value(evaluator.position(at.patch, at.u, at.v)) / plane->normal.norm() / reach;
          if (std::abs(distance) >= 1) continue;
          const double share = slideWidth > 0 ? std::pow(1 - distance * distance, 2) : 1.0;
          slides_.push_back(
              {point, slide(plane->normal, evaluator.normal(at.patch, at.u, at.v), share)});
        }
  }
}

Eigen::Matrix3Xd MaterialPoints::byControlPoints(const Eigen::Matrix3Xd& byPoints) const {
  Eigen::Matrix3Xd byMaterial = byPoints;
  for (const Slide& each : slides_)
    byMaterial.col(each.point) = each.motion.transpose() * byMaterial.col(each.point);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, controlPoints_);
  for (Eigen::Index point = 0; point < byMaterial.cols(); ++point)
    for (std::size_t k = first_[static_cast<std::size_t>(point)];
         k < first_[static_cast<std::size_t>(point) + 1]; ++k)
      result.col(weights_[k].controlPoint) += weights_[k].value * byMaterial.col(point);
  return result;
}

}  // namespace palpa::app
