#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <functional>

namespace palpa::mpi {

/// A linear system with several right-hand sides, each on one rank. All columns have the same
/// number of rows; a rank may have none.
struct ColumnSystem {
  /// The matrix times all columns, for the columns of this rank; collective.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> apply;
  /// Approximate solutions for columns of this rank alone.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> precondition;
};

struct ColumnSolution {
  Eigen::MatrixXd x;
  double residual = 0;  ///< |b - A x| / |b|, of all columns together
};

/// Solves the columns as one vector by PETSc's flexible GMRES (a shell matrix, a shell
/// preconditioner), so that all products are of many columns; collective. `b`: the columns of this
/// rank. Rethrows what `apply` and `precondition` throw.
ColumnSolution solveColumns(MPI_Comm communicator, const ColumnSystem& system,
                            const Eigen::MatrixXd& b, double tolerance, int maxSteps);

}  // namespace palpa::mpi
