#pragma once

#include <vector>

#include "base/byte_stream.h"
#include "base/job.h"
#include "bem/base/large_matrix.h"

namespace palpa::bem {

/// P A = L U with partial pivoting, in place, through LAPACK and BLAS (float or double). By blocks
/// of columns on the job's threads; the factors do not depend on their number.
template <class Scalar>
class LuFactorisation {
 public:
  /// Takes the square matrix over. Throws SolverError (kSingular) when a pivot vanishes, Cancelled
  /// on stop.
  LuFactorisation(LargeMatrix<Scalar> matrix, const Job& job);
  /// What write() wrote, of a matrix with `size` rows.
  LuFactorisation(Eigen::Index size, const ByteSource& source);
  void write(const ByteSink& sink) const;

  Eigen::Index size() const { return matrix_.rows(); }
  std::size_t bytes() const { return matrix_.bytes(); }

  /// Overwrites the columns of `rightHandSides` (size() rows) with the solutions. Safe to call from
  /// several threads. Throws Cancelled.
  void solveInPlace(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides,
                    const Job& job = {}) const;

  /// LAPACK's estimate of the condition number in the 1-norm: about five solutions. Throws
  /// Cancelled between two of them.
  double conditionEstimate(const Job& job = {}) const;

 private:
  LargeMatrix<Scalar> matrix_;
  std::vector<int> pivots_;
  double norm1_ = 0;
};

}  // namespace palpa::bem
