#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// Gaussian elimination with partial pivoting that allocates nothing, for the systems of a few
/// hundred unknowns that are solved a thousand times a second. The matrix, and with it the right
/// side as its last column, is overwritten: solves A x = b for `system` = [A b] (rows() x rows() +
/// 1). Afterwards the last column holds x, not finite when A is singular. The same numbers give
/// the same result to the last bit, on any number of threads.
void solveByElimination(Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> system);

}  // namespace palpa::bem
