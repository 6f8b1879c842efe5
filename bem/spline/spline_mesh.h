#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "bem/model/boundary_conditions.h"
#include "bem/model/surface_point.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// A triangle mesh on a spline surface, as people see and touch it: which splines weigh how much at
/// its nodes, and where on the patches a point of a triangle is. Triangles lie in one patch and in
/// one part each (equal tags of triangles and elements mean the same part), but may reach over
/// several elements. Immutable; const use from several threads is safe. Surface, tractions, mesh
/// and slots must outlive it.
class SplineMesh {
 public:
  /// The patch of a triangle and the parameters of its corners in it.
  struct Triangle {
    int patch;
    std::array<Eigen::Vector2d, 3> corners;
  };

  /// `meshSlots`: of the mesh; `triangles`: one per triangle of the mesh. About 2 µs per corner.
  SplineMesh(const SplineSurface& surface, const SplineTractions& tractions,
             const BoundaryMesh& mesh, const TractionSlots& meshSlots,
             std::vector<Triangle> triangles);

  const SplineSurface& surface() const { return surface_; }
  const SplineTractions& tractions() const { return tractions_; }
  const BoundaryMesh& mesh() const { return mesh_; }
  const TractionSlots& meshSlots() const { return meshSlots_; }
  const Triangle& triangle(int index) const { return triangles_[index]; }

  /// A point of the true surface: an element of the triangle's part, and parameters in its patch,
  /// which may lie a little outside of the element where a border was cut.
  struct Point {
    int element;
    Eigen::Vector2d parameters;
  };
  Point at(const SurfacePoint& point) const { return at(point.triangle, point.weights); }
  Point at(int triangle, const Eigen::Vector3d& weights) const;

  /// Weights of the displacement coefficients at the nodes: u of node k is row k times u_j.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& nodeWeights() const { return nodeWeights_; }
  /// Weights of the traction coefficients at the slots of the mesh.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& slotWeights() const { return slotWeights_; }

  /// Displacements of the nodes (3 per node) from coefficients (3 each), column by column.
  void displacements(const Eigen::MatrixXd& coefficients, Eigen::MatrixXd& ofNodes) const;
  /// Tractions of the mesh's slots (3 per slot) from coefficients.
  void tractions(const Eigen::MatrixXd& coefficients, Eigen::MatrixXd& ofSlots) const;

 private:
  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  const BoundaryMesh& mesh_;
  const TractionSlots& meshSlots_;
  std::vector<Triangle> triangles_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> nodeWeights_, slotWeights_;
};

}  // namespace palpa::bem
