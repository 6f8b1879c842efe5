#pragma once

#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Solves A0^T w = r (one column per right-hand side) with the factors of a problem of
/// makeDenseReferenceProblem(): the change of any linear function of the unknowns per change of the
/// equations. Relative error about 1e-4 where the factors are in single precision. Throws
/// SolverError (kBadCondition) for an incremental update, whose factors belong to another shape,
/// and (kTooLarge) for compressed operators.
Eigen::MatrixXd solveTransposed(const ReferenceProblem& problem, const Eigen::MatrixXd& r);

/// G^T λ: one number per component of a traction coefficient. Throws as above.
Eigen::VectorXd transposedTractions(const ReferenceProblem& problem, const Eigen::VectorXd& lambda);

/// Derivatives of ψ·u by the unknowns v of a problem, for the right-hand side of the above: one
/// column per column of ψ (3 rows per displacement coefficient).
Eigen::MatrixXd derivativeByUnknowns(const DegreesOfFreedom& dofs, const Eigen::MatrixXd& psi);

}  // namespace palpa::bem
