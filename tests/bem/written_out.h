#pragma once

#include "bem/model/boundary_conditions.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem::test {

/// The two matrices of A v + Ā v̄ = 0, computed column by column from H and G: the definition
/// against which the capacitance method is checked.
struct WrittenOut {
  Eigen::MatrixXd A, ABar;

  WrittenOut(const BoundaryOperators<double>& operators, const DegreesOfFreedom& dofs);

  Eigen::VectorXd solveSwitched(const std::vector<int>& nodes, const Eigen::VectorXd& known) const;
};

}  // namespace palpa::bem::test
