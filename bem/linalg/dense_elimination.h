#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// Gaussian elimination with partial pivoting, without allocation, for systems of a few hundred
/// unknowns that are solved a thousand times a second. Solves A x = b for `system` = [A b] (rows()
/// x rows() + 1) and overwrites it; afterwards the last column is x, not finite if A is singular.
/// Deterministic to the last bit.
void solveByElimination(Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> system);

}  // namespace palpa::bem
