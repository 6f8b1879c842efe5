#pragma once

#include "modeling/mesh/plane_section.h"

// Internal to planeSection().
namespace palpa::modeling {

/// A closed line in which a plane cuts a mesh. Seen from the normal's side the body lies on its
/// left.
struct SectionLoop {
  std::vector<Eigen::Vector3d> positions;
  std::vector<PlaneSection::OutlinePoint> points;  ///< on one edge of the mesh each
};

/// All closed lines. A vertex in the plane counts as in front of it, so that every line is closed
/// also where the plane touches edges or faces. Points that lie so close together that triangles
/// between them would be tiny are merged, except at corners.
std::vector<SectionLoop> sectionOutline(const std::vector<Eigen::Vector3d>& positions,
                                        const std::vector<std::array<int, 3>>& triangles,
                                        const Plane& plane);

}  // namespace palpa::modeling
