#pragma once

#include <array>

#include "modeling/exchange/polygon_soup.h"

namespace palpa::modeling {

/// A closed, oriented triangle surface made from a soup.
struct ClosedSurface {
  std::vector<Eigen::Vector3d> positions;  ///< mm, each used
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> groups;  ///< per triangle, as in the soup; empty when there is one only
};

/// Fits the polygons of a soup together: triangles, common vertices, one orientation. Says what is
/// wrong with the number of places and the first of them. Not yet checked: whether the surface cuts
/// itself, and which side is inside.
/// @throws ModelingError (without the file's name), Cancelled
ClosedSurface closeSurface(const PolygonSoup& soup, double scale, const Job& job);

/// Removes triangles without area, refuses a surface that cuts itself or consists of several
/// bodies, and turns the triangles so that their normals point out of the material (CGAL).
/// @throws ModelingError (without the file's name), Cancelled between the steps
void makeBoundary(ClosedSurface& surface, const Job& job);

}  // namespace palpa::modeling
