#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "base/job.h"
#include "bem/base/large_matrix.h"
#include "bem/element/averaged_rows.h"

namespace palpa::bem {

/// Weights of consecutive points in the equations: adds the rows of these points to the rows of the
/// equations. Rows are ordered as [i * count + point] and [i * count + equation], i < 3.
template <class Scalar>
class PointWeights {
 public:
  /// Columns that are processed together, one or two vectors of the processor.
  static constexpr int kColumns = 16;

  /// Of the points first … first + count - 1 of all weights (equation, point).
  PointWeights(const Eigen::SparseMatrix<double>& all, Eigen::Index first, Eigen::Index count);

  /// Adds the weighted rows of the points for up to kColumns columns.
  void add(const LargeMatrix<Scalar>& ofPoints, Eigen::Index firstColumn,
           LargeMatrix<Scalar>& ofEquations) const;

 private:
  std::vector<Eigen::Index> equations_;  ///< those with a weight
  Eigen::SparseMatrix<Scalar, Eigen::RowMajor> weights_;
};

/// Adds blocks of averaged elements to a matrix with a column for each of some functions.
template <class Scalar>
class BlockScatter {
 public:
  /// `functions`: of the columns, ascending; `equationCount`: a third of the rows.
  BlockScatter(std::span<const int> functions, Eigen::Index equationCount);

  struct Part {
    const std::vector<int>*equations, *functions;
    const Eigen::MatrixXd* block;  ///< [3 equation + i][3 function + c]
  };
  /// Each column gets all its parts in their order: the result does not depend on the number of
  /// threads. Column by column, because the columns are far apart in memory.
  void add(std::span<const Part> parts, const Job& job, LargeMatrix<Scalar>& matrix);

 private:
  struct Source {
    int part, function;
  };
  std::vector<int> columns_;                  ///< of each function; -1: none
  std::vector<std::vector<Source>> sources_;  ///< of each column
  Eigen::Index equationCount_;
};

}  // namespace palpa::bem
