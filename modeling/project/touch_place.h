#pragma once

#include <Eigen/Core>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// A place for a first touch.
struct TouchPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm, on the surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, outwards
  /// Radius (mm) of a touch that stays clear of sharp edges and supports: the wished one, or the
  /// distance to them if that is smaller, but at least a quarter of the wished one. Two digits.
  double radius = 0.0;
};

/// The place opposite to the supports, where pressing moves the body most directly against them.
///
/// The supports have a centroid c and a mean outward normal m, both weighted by area. The height of
/// a surface point x is (c − x) · m. The place is the highest one, among the points that look away
/// from the supports (the angle between the outward normal and −m is at most 60°) and whose
/// distance to every sharp edge, to the supports and to places where the surface has turned by 60
/// to 120° (the sides of a thin pin) is at least `radius`. Points whose heights differ by less than
/// a fiftieth of the largest count as equally high; of these, the one farthest from edges and
/// supports is chosen (within a twentieth, the one nearest to the axis along m through c): the
/// middle of a flat top. If there is no such point in the upper half, the distance and then the
/// angle are relaxed. If the supports surround the body, so that their normals cancel, m points
/// from the body's centroid to c, and if these coincide, the place is the point farthest from the
/// supports.
///
/// `radius`: wished radius of the touch, mm, > 0. Deterministic; rounding may choose between places
/// of equal rank. Cost: below a second for a million triangles. Throws ModelingError if there is no
/// support or if the supports cover the whole surface.
TouchPlace placeOppositeToSupports(const Body& body, const std::vector<Support>& supports,
                                   double radius);

}  // namespace palpa::modeling
