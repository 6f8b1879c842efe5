#pragma once

#include <vector>

#include "base/byte_stream.h"
#include "base/job.h"
#include "bem/base/large_matrix.h"

namespace palpa::bem {

/// P A = L U with partial pivoting by LAPACK and BLAS, in float or double. Blocks of columns are
/// distributed over the job's threads; the factors do not depend on the number of threads.
template <class Scalar>
class LuFactorisation {
 public:
  /// Factorises the square matrix in its memory. Throws SolverError (kSingular) if a pivot
  /// vanishes; Cancelled.
  LuFactorisation(LargeMatrix<Scalar> matrix, const Job& job);
  /// Reads the output of write() for a matrix with `size` rows.
  LuFactorisation(Eigen::Index size, const ByteSource& source);
  void write(const ByteSink& sink) const;

  Eigen::Index size() const { return matrix_.rows(); }
  std::size_t bytes() const { return matrix_.bytes(); }

  /// Overwrites the columns of `rightHandSides` (size() rows) with the solutions. Safe to call from
  /// several threads. Throws Cancelled.
  void solveInPlace(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides,
                    const Job& job = {}) const;

  /// The same with the transposed matrix.
  void solveTransposedInPlace(
      Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides) const;

  /// LAPACK's estimate of the condition number in the 1-norm. Costs about five solutions. Throws
  /// Cancelled.
  double conditionEstimate(const Job& job = {}) const;

 private:
  LargeMatrix<Scalar> matrix_;
  std::vector<int> pivots_;
  double norm1_ = 0;
};

}  // namespace palpa::bem
