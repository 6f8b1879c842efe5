#include "app/mpi/column_solver.h"

#include <petscksp.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace palpa::mpi {
namespace {

using Eigen::MatrixXd;

/// What the callbacks need; PETSc passes a pointer to it.
struct Callbacks {
  const ColumnSystem& system;
  Eigen::Index rows, columns;
  std::exception_ptr failure{};
};

/// y = use(x) for the columns of a rank. Exceptions must not pass through PETSc.
template <class Use>
PetscErrorCode mapColumns(Callbacks& callbacks, Vec x, Vec y, const Use& use) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  VecGetArrayRead(x, &from);
  VecGetArrayWrite(y, &to);
  PetscErrorCode code = 0;
  try {
    Eigen::Map<MatrixXd>(to, callbacks.rows, callbacks.columns) =
        use(MatrixXd(Eigen::Map<const MatrixXd>(from, callbacks.rows, callbacks.columns)));
  } catch (...) {
    callbacks.failure = std::current_exception();
    code = PETSC_ERR_USER;
  }
  VecRestoreArrayWrite(y, &to);
  VecRestoreArrayRead(x, &from);
  return code;
}

PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
  Callbacks* callbacks = nullptr;
  MatShellGetContext(matrix, &callbacks);
  return mapColumns(*callbacks, x, y, callbacks->system.apply);
}

PetscErrorCode precondition(PC preconditioner, Vec x, Vec y) {
  Callbacks* callbacks = nullptr;
  PCShellGetContext(preconditioner, &callbacks);
  return mapColumns(*callbacks, x, y, callbacks->system.precondition);
}

/// The objects of one solution.
class Krylov {
 public:
  Krylov(MPI_Comm communicator, Callbacks& callbacks, MatrixXd& b, MatrixXd& x) {
    const auto local = static_cast<PetscInt>(b.size());
    check(MatCreateShell(communicator, local, local, PETSC_DETERMINE, PETSC_DETERMINE, &callbacks,
                         &matrix_));
    check(MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(VecCreateMPIWithArray(communicator, 1, local, PETSC_DETERMINE, b.data(), &b_));
    check(VecCreateMPIWithArray(communicator, 1, local, PETSC_DETERMINE, x.data(), &x_));
    check(KSPCreate(communicator, &solver_));
    check(KSPSetOperators(solver_, matrix_, matrix_));
    check(KSPSetType(solver_, KSPFGMRES));
    check(KSPGMRESSetCGSRefinementType(solver_, KSP_GMRES_CGS_REFINE_IFNEEDED));
    PC preconditioner = nullptr;
    check(KSPGetPC(solver_, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, &callbacks));
    check(PCShellSetApply(preconditioner, precondition));
  }
  ~Krylov() {
    KSPDestroy(&solver_);
    VecDestroy(&x_);
    VecDestroy(&b_);
    MatDestroy(&matrix_);
  }
  Krylov(const Krylov&) = delete;
  Krylov& operator=(const Krylov&) = delete;

  void solve(double tolerance, int maxSteps, Callbacks& callbacks, ColumnSolution& solution) {
    check(KSPGMRESSetRestart(solver_, maxSteps));
    check(KSPSetTolerances(solver_, tolerance, 1e-300, PETSC_DEFAULT, maxSteps));
    const PetscErrorCode code = KSPSolve(solver_, b_, x_);
    if (callbacks.failure) std::rethrow_exception(callbacks.failure);
    check(code);
    PetscReal residual = 0, norm = 0;
    check(KSPGetResidualNorm(solver_, &residual));
    check(VecNorm(b_, NORM_2, &norm));
    solution.residual = norm > 0 ? residual / norm : 0;
  }

 private:
  static void check(PetscErrorCode code) {
    if (code != 0) throw std::runtime_error("PETSc failed with its error " + std::to_string(code));
  }

  Mat matrix_ = nullptr;
  Vec b_ = nullptr, x_ = nullptr;
  KSP solver_ = nullptr;
};

}  // namespace

ColumnSolution solveColumns(MPI_Comm communicator, const ColumnSystem& system, const MatrixXd& b,
                            double tolerance, int maxSteps) {
  Callbacks callbacks{system, b.rows(), b.cols()};
  MatrixXd right = b;
  ColumnSolution solution;
  solution.x = MatrixXd::Zero(b.rows(), b.cols());
  Krylov(communicator, callbacks, right, solution.x)
      .solve(tolerance, maxSteps, callbacks, solution);
  return solution;
}

}  // namespace palpa::mpi
