#pragma once
#include <vector>

#include "bem/job.h"
#include "bem/large_matrix.h"

namespace palpa::bem {

/// P A = L U with partial pivoting, in place, through LAPACK and BLAS (float or double). Panel by
/// panel, so that it can be cancelled and show its progress.
template <class Scalar>
class LuFactorisation {
 public:
  /// Takes the square matrix over. Throws SolverError (kSingular) when a pivot vanishes, Cancelled
  /// on stop.
  LuFactorisation(LargeMatrix<Scalar> matrix, const Job& job);

  Eigen::Index size() const { return matrix_.rows(); }
  std::size_t bytes() const { return matrix_.bytes(); }

  /// Overwrites the columns of `rightHandSides` (size() rows) with the solutions. Safe to call from
  /// several threads.
  void solveInPlace(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides) const;

  /// LAPACK's estimate of the condition number in the 1-norm.
  double conditionEstimate() const;

 private:
  LargeMatrix<Scalar> matrix_;
  std::vector<int> pivots_;
  double norm1_ = 0;
};

}  // namespace palpa::bem
