#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "bem/element/element_equations.h"
#include "bem/element/element_surface.h"

namespace palpa::bem {

/// Displacements [3 node + i][motion] of six rigid motions of nodes, mm: translations by 1 mm,
/// then rotations by 1 rad about axes through `centre`, linearised.
Eigen::MatrixXd rigidMotions(const std::vector<Eigen::Vector3d>& nodes,
                             const Eigen::Vector3d& centre);

/// Annuls residuals of rigid motions, which quadrature, interpolation and rounding leave: slender
/// bodies turn residuals of rotations into large displacements of their ends.
class RigidCorrection {
 public:
  /// `motions`: of the surface's coefficients, see rigidMotions(). The arguments must outlive this
  /// object.
  RigidCorrection(const ElementSurface& surface, const WeightedEquations& equations,
                  const Eigen::MatrixXd& motions);

  /// Coefficients and the blocks in their columns that the row of an equation needs in addition, if
  /// its products with the motions differ by `residuals` from the exact ones: of all such blocks at
  /// the functions of the elements that the points of the equation are in, those with the smallest
  /// sum of squares. The coefficients ascend.
  std::vector<std::pair<int, Eigen::Matrix3d>> blocks(
      Eigen::Index equation, const Eigen::Matrix<double, 3, 6>& residuals) const;

 private:
  const ElementSurface& surface_;
  const WeightedEquations& equations_;
  const Eigen::MatrixXd& motions_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights_;
};

}  // namespace palpa::bem
