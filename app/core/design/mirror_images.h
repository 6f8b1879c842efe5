#pragma once

#include <Eigen/Dense>
#include <vector>

#include "modeling/solid/mirror_plane.h"
#include "modeling/solid/solid.h"

namespace palpa::app {

/// Mirror images of a solid's control points about planes, and about all combinations of them.
class MirrorImages {
 public:
  /// Throws ModelingError if combinations of the planes give more than 48 images.
  MirrorImages(const modeling::Solid& solid, const std::vector<modeling::MirrorPlane>& planes);

  struct Image {
    int point;
    Eigen::Matrix3d map;  ///< of directions at the original
  };
  struct Orbit {
    std::vector<Image> images;  ///< each point once, the original first
    /// Projector onto the directions that the planes through the original keep.
    Eigen::Matrix3d keep;
  };
  /// Throws ModelingError that begins with `design.mirrors` if the solid has no control point at a
  /// mirrored place (within 1e-6 of its size).
  Orbit of(int point) const;

 private:
  struct Motion {
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift;
  };
  std::vector<Eigen::Vector3d> points_;
  double tolerance_;
  std::vector<Motion> motions_;  ///< the identity first
};

}  // namespace palpa::app
