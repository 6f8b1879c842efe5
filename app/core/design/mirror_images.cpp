#include "app/core/design/mirror_images.h"

#include <algorithm>

#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {

using Eigen::Matrix3d;
using Eigen::Vector3d;

MirrorImages::MirrorImages(const modeling::Solid& solid,
                           const std::vector<modeling::MirrorPlane>& planes)
    : points_(solid.controlPoints()) {
  constexpr std::size_t kMaxImages = 48;  // of a cube
  const auto [low, high] = modeling::boundingBox(solid);
  const double size = (high - low).norm();
  tolerance_ = 1e-6 * size;
  motions_.push_back({Matrix3d::Identity(), Vector3d::Zero()});
  std::vector<Motion> reflections;
  for (const modeling::MirrorPlane& plane : planes) {
    const Vector3d normal = plane.normal.normalized();
    reflections.push_back({Matrix3d::Identity() - 2 * normal * normal.transpose(),
                           2 * normal.dot(plane.point) * normal});
  }
  for (std::size_t k = 0; k < motions_.size(); ++k)
    for (const Motion& reflection : reflections) {
      const Motion next{reflection.turn * motions_[k].turn,
                        reflection.turn * motions_[k].shift + reflection.shift};
      if (std::any_of(motions_.begin(), motions_.end(), [&](const Motion& known) {
            return (known.turn - next.turn).norm() < 1e-6 &&
                   (known.shift - next.shift).norm() < tolerance_;
          }))
        continue;
      if (motions_.size() == kMaxImages)
        throw modeling::ModelingError(
            "design.mirrors: together the planes give more than 48 images; use planes at right "
            "angles");
      motions_.push_back(next);
    }
}

MirrorImages::Orbit MirrorImages::of(int point) const {
  Orbit orbit;
  Matrix3d sum = Matrix3d::Zero();
  int fixedBy = 0;
  const Vector3d& from = points_[static_cast<std::size_t>(point)];
  for (const Motion& motion : motions_) {
    const Vector3d place = motion.turn * from + motion.shift;
    int nearest = point;
    double least = (from - place).norm();
    if (least <= tolerance_) {
      sum += motion.turn;
      ++fixedBy;
    } else {
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (const double distance = (points_[i] - place).norm(); distance < least) {
          least = distance;
          nearest = static_cast<int>(i);
        }
      if (least > tolerance_)
        throw modeling::ModelingError("design.mirrors: control point " + std::to_string(point) +
                                      " has no mirror image; the solid is not symmetric about "
                                      "these planes");
    }
    if (std::none_of(orbit.images.begin(), orbit.images.end(),
                     [&](const Image& image) { return image.point == nearest; }))
      orbit.images.push_back({nearest, motion.turn});
  }
  orbit.keep = sum / fixedBy;  // the mean of a group is a projector
  return orbit;
}

}  // namespace palpa::app
