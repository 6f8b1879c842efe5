#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "base/box_tree.h"
#include "modeling/body/mesh_body.h"

// Nearest points, rays and normals on the triangles of a mesh body. Internal to modeling/measure.
namespace palpa::modeling {

/// Triangles of a mesh body with trees for searching. Faces and triangles are indices of the body,
/// lengths in mm. Immutable; several threads may use it.
class MeshSurface {
 public:
  /// Cost: some milliseconds per hundred thousand triangles.
  explicit MeshSurface(const MeshBody& body);

  const MeshBody& body() const { return body_; }
  /// Diagonal of the body's box, mm.
  double size() const { return size_; }
  /// Neighbours of each triangle as triangleNeighbours().
  const std::vector<std::array<int, 3>>& neighbours() const { return neighbours_; }
  /// Outward normal of a triangle, as long as twice its area (mm²).
  const Eigen::Vector3d& areaNormal(int triangle) const { return areaNormals_[triangle]; }
  const std::vector<int>& trianglesOf(int face) const { return trianglesOf_[face]; }

  /// Nearest point of the whole surface.
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;
  Eigen::Vector3d nearestOnFace(int face, const Eigen::Vector3d& x) const;
  /// Triangle of a face that is nearest to a point.
  int triangleAt(int face, const Eigen::Vector3d& x) const;
  /// Smallest s > `least` with origin + s direction on the surface; unit direction, mm.
  std::optional<double> firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double least) const;

  /// Unit normal of the curved surface that the triangles of a face approximate, at a point of the
  /// face: interpolated between the corners of its triangle, where it is the mean, by angle, of the
  /// triangles of the face without a sharp edge (kSharpEdgeDegrees) between them.
  Eigen::Vector3d normalAt(int face, const Eigen::Vector3d& x) const;
  /// Triangles of the same face that no sharp edge separates from the first, which they begin with.
  std::vector<int> smoothAround(int triangle) const;
  /// Largest height of these triangles above a neighbour without a sharp edge between them, mm.
  double facetHeight(int triangle) const;

 private:
  /// Replaces `best` if the triangle is nearer to x than `least`. Returns the new `least`.
  double keepNearer(int triangle, const Eigen::Vector3d& x, double& least,
                    Eigen::Vector3d& best) const;

  MeshBody body_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Eigen::Vector3d> areaNormals_;
  std::vector<int> firstAt_, trianglesAt_;  // triangles around each vertex, one after another
  std::vector<std::vector<int>> trianglesOf_;
  std::vector<BoxTree> faceTrees_;
  BoxTree tree_;
  double size_ = 0;
};

}  // namespace palpa::modeling
