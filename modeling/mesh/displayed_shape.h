#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

/// Surface under the boundary mesh: points on edges and in triangles, and normals.
class DisplayedShape {
 public:
  virtual ~DisplayedShape() = default;

  struct Point {
    Eigen::Vector3d position;
    std::vector<SurfaceParameter> at;  ///< in each of its patches; empty without a spline surface
  };

  /// The point at the fraction s of the edge from a to b; `left` and `right` are its triangles.
  virtual Point onEdge(int a, int b, double s, int left, int right) const = 0;
  virtual Point inTriangle(int triangle, const Eigen::Vector3d& weights) const = 0;
  virtual Point atNode(int node) const = 0;
  /// Unit normal at a point, continuous within the smoothing group of the triangle.
  virtual Eigen::Vector3d normal(const Point& point, int triangle,
                                 const Eigen::Vector3d& weights) const = 0;
};

/// The patches of a solid, or the flat triangles of other meshes. Mesh and body must outlive it.
std::unique_ptr<DisplayedShape> makeDisplayedShape(const SurfaceMesh& mesh, const Body& body);

}  // namespace palpa::modeling
