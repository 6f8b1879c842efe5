#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// The small dense matrix C of the capacitance method with its inverse, which is updated when rows
/// and columns join and leave (O(s^2) each) instead of factorised again (O(s^3)). C need not be
/// symmetric.
///
/// Joining borders the matrix, C' = [C B; R D]; with the Schur complement S = D - R C^-1 B the
/// inverse is
///   [C^-1 + C^-1 B S^-1 R C^-1, -C^-1 B S^-1; -S^-1 R C^-1, S^-1].
/// Leaving undoes it: with the inverse partitioned as [P11 P12; P21 P22], the inverse of what stays
/// is P11 - P12 P22^-1 P21. (Hager, Updating the inverse of a matrix, SIAM Review 31 (1989)
/// 221-239.) A test vector measures the rounding errors; when they have grown, the inverse is
/// computed from scratch. Every solution gets one step of refinement.
class CapacitanceMatrix {
 public:
  Eigen::Index size() const { return matrix_.rows(); }
  const Eigen::MatrixXd& matrix() const { return matrix_; }

  /// Adds b unknowns: `column` (s x b), `row` (b x s), `corner` (b x b). Throws SolverError
  /// (kSingular) and leaves the matrix unchanged if the new unknowns depend on the old ones (two
  /// contacts at the same place).
  void append(const Eigen::MatrixXd& column, const Eigen::MatrixXd& row,
              const Eigen::MatrixXd& corner);
  /// Removes unknowns [first, first + count).
  void remove(Eigen::Index first, Eigen::Index count);
  /// C^-1 times the right-hand side.
  Eigen::VectorXd solve(const Eigen::VectorXd& rightHandSide) const;

 private:
  void refreshIfDrifted();

  Eigen::MatrixXd matrix_;
  Eigen::MatrixXd inverse_;
};

}  // namespace palpa::bem
