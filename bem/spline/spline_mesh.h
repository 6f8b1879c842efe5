#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "bem/model/boundary_conditions.h"
#include "bem/model/surface_point.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Triangle mesh on a spline surface, used for display and for naming surface points: the weights
/// of the splines at the mesh nodes, and the position of triangle points on the patches. Each
/// triangle lies in one patch and in one part (equal tags of triangles and elements denote the same
/// part) but may extend over several elements. Immutable; const use from several threads is safe.
/// Surface, tractions, mesh and slots must outlive it.
class SplineMesh {
 public:
  /// Patch of a triangle and the parameters of its corners.
  struct Triangle {
    int patch;
    std::array<Eigen::Vector2d, 3> corners;
  };

  /// `meshSlots`: slots of the mesh; `triangles`: one per triangle of the mesh. Takes about 2 µs
  /// per corner.
  SplineMesh(const SplineSurface& surface, const SplineTractions& tractions,
             const BoundaryMesh& mesh, const TractionSlots& meshSlots,
             std::vector<Triangle> triangles);

  const SplineSurface& surface() const { return surface_; }
  const SplineTractions& tractions() const { return tractions_; }
  const BoundaryMesh& mesh() const { return mesh_; }
  const TractionSlots& meshSlots() const { return meshSlots_; }
  const Triangle& triangle(int index) const { return triangles_[index]; }

  /// Point of the true surface: an element of the triangle's part, and parameters in the patch of
  /// the element. The parameters may lie slightly outside the element where a border was cut.
  struct Point {
    int element;
    Eigen::Vector2d parameters;
  };
  Point at(const SurfacePoint& point) const { return at(point.triangle, point.weights); }
  Point at(int triangle, const Eigen::Vector3d& weights) const;

  /// Weights of the displacement coefficients at the nodes, one row per node: u of node k is row k
  /// times u_j.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& nodeWeights() const { return nodeWeights_; }
  /// Weights of the traction coefficients at the slots of the mesh, one row per slot.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& slotWeights() const { return slotWeights_; }

  /// Displacements of the nodes (3 rows per node) from coefficients (3 rows each), column by
  /// column.
  void displacements(const Eigen::MatrixXd& coefficients, Eigen::MatrixXd& ofNodes) const;
  /// Tractions of the mesh's slots (3 rows per slot) from coefficients, column by column.
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
