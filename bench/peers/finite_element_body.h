#pragma once

#include <functional>

#include "bench/peers/finite_elements.h"
#include "bench/peers/sparse_cholesky.h"
#include "bench/peers/surface_mask.h"

namespace palpa::bench {

/// A body of tetrahedra that is fixed at its tagged faces and can be touched like Palpa's models:
/// with the traction mask of bem/contact/contact_mask.h, whose forces and conjugate displacements
/// are related by D = F^T K^-1 F with the nodal forces F of the mask.
class FiniteElementBody {
 public:
  using Displacement = std::function<Eigen::Vector3d(const Eigen::Vector3d& position)>;
  using Traction = std::function<Eigen::Vector3d(const Eigen::Vector3d& position,
                                                 const Eigen::Vector3d& normal)>;

  /// Factorises. `elements`: of the mesh.
  FiniteElementBody(TetrahedralMesh mesh, FiniteElements elements)
      : mesh_(std::move(mesh)), elements_(std::move(elements)), cholesky_(elements_.stiffness) {}

  const TetrahedralMesh& mesh() const { return mesh_; }
  const FiniteElements& elements() const { return elements_; }
  SparseCholesky& factors() { return cholesky_; }
  int unknowns() const { return 3 * elements_.freeCount; }

  /// Displacements of all nodes (3 each, mm) with displacements given on tagged faces and tractions
  /// (MPa) on the others.
  Eigen::VectorXd solve(const Displacement& displacement, const Traction& traction);

  /// Compliance of a touch at a place.
  struct Touch {
    Eigen::Matrix3d compliance;  ///< D, mm/N
    Eigen::MatrixXd half;        ///< L^-1 P F
  };
  Touch touch(const SurfaceMask& mask);
  /// Displacements of the free nodes for a force of the touch, N.
  Eigen::VectorXd field(const Touch& touch, const Eigen::Vector3d& force);

  /// Displacements of some free nodes of the mesh by unit forces on each of them, sufficient for
  /// all touches among them. Symmetric.
  Eigen::MatrixXd condensedCompliance(const std::vector<int>& nodes);

 private:
  TetrahedralMesh mesh_;
  FiniteElements elements_;
  SparseCholesky cholesky_;
};

/// Relative L2 error of the displacements of all nodes on the surface.
double surfaceError(const TetrahedralMesh& mesh, const Eigen::VectorXd& u,
                    const FiniteElementBody::Displacement& exact);

}  // namespace palpa::bench
