#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "base/job.h"

namespace palpa::modeling {

/// The plane normal . x = offset.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit
  double offset = 0;                                  ///< mm

  /// Signed distance, mm, positive on the side to which the normal points.
  double distance(const Eigen::Vector3d& x) const { return normal.dot(x) - offset; }
};

/// Triangulated intersection of a plane with the body that a closed triangle mesh bounds. The body
/// may have cavities, and the section several pieces. Empty if the plane misses the body or only
/// touches it.
struct PlaneSection {
  /// A point of the outline as the weighted mean of vertices of the mesh.
  struct OutlinePoint {
    std::array<int, 4> vertices;  ///< unused ones have the weight 0
    std::array<double, 4> weights;
  };
  std::vector<Eigen::Vector3d> positions;     ///< mm; first the outline, then interior points
  std::vector<OutlinePoint> outline;          ///< of the first positions
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the normal's side
  std::vector<std::array<int, 2>> edges;      ///< of the outline, as pairs of points
};

inline constexpr int kMaxSectionPoints = 4000;  ///< that planeSection() adds

/// Cuts a closed mesh. Vertices may be split; split ones have the same positions up to rounding.
/// Triangles have the size of the mesh's at the outline and grow towards `edgeLength` (mm) inside:
/// a constrained Delaunay triangulation refined by Delaunay's criterion (CGAL).
///
/// Cost: some microseconds per triangle of the mesh and per point. Throws Cancelled.
PlaneSection planeSection(const std::vector<Eigen::Vector3d>& positions,
                          const std::vector<std::array<int, 3>>& triangles, const Plane& plane,
                          double edgeLength, const Job& job = {});

}  // namespace palpa::modeling
