#pragma once

#include <array>

#include "modeling/exchange/polygon_soup.h"

namespace palpa::modeling {

/// Closed, oriented triangle surface from a polygon soup.
struct ClosedSurface {
  std::vector<Eigen::Vector3d> positions;  ///< mm, each used by a triangle
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> groups;  ///< per triangle, as in the soup; empty if there is only one group
  std::vector<int> bodies;  ///< per triangle, from makeBoundary(); empty if there is only one body
};

/// Joins the polygons of a soup: cuts them into triangles, merges vertices, orients the triangles
/// consistently. `scale` is in mm per unit of the soup. Does not check for self-intersections and
/// does not determine which side is inside.
/// Throws ModelingError (without the file's name) with the number of faulty places and the first of
/// them; Cancelled.
ClosedSurface closeSurface(const PolygonSoup& soup, double scale, const Job& job);

/// Removes triangles without area and orients the others so that their normals point out of the
/// material (CGAL). Numbers the bodies in the order of their first triangles: closed surfaces with
/// the cavities directly inside them.
/// Throws ModelingError (without the file's name) if the surface intersects itself; Cancelled,
/// between the steps only.
void makeBoundary(ClosedSurface& surface, const Job& job);

/// Keeps one of the bodies.
void keepBody(ClosedSurface& surface, int body);

}  // namespace palpa::modeling
