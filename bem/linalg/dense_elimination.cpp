#include "bem/linalg/dense_elimination.h"

#include <algorithm>

namespace palpa::bem {
namespace {

using Eigen::Index;
using System = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

constexpr Index kPanel = 8;  // columns eliminated together

/// Swaps the row with the largest entry of a column, from `row` on down, into `row`.
void pivot(System& a, Index row, Index column) {
  Index best = 0;
  a.col(column).tail(a.rows() - row).cwiseAbs().maxCoeff(&best);
  if (best > 0) a.row(row).swap(a.row(row + best));
}

/// rest -= left * top, with `width` columns in `left`.
void subtractProduct(System& a, Index first, Index width) {
  const Index next = first + width, rows = a.rows() - next, columns = a.cols() - next;
  if (rows == 0) return;
  auto rest = a.block(next, next, rows, columns);
  if (width == kPanel)
    rest.noalias() -=
        a.block<Eigen::Dynamic, kPanel>(next, first, rows, kPanel)
            .lazyProduct(a.block<kPanel, Eigen::Dynamic>(first, next, kPanel, columns));
  else
    rest.noalias() -=
        a.block(next, first, rows, width).lazyProduct(a.block(first, next, width, columns));
}

}  // namespace

void solveByElimination(System a) {
  const Index size = a.rows();
  for (Index first = 0; first < size; first += kPanel) {
    const Index width = std::min(kPanel, size - first), next = first + width;
    for (Index k = first; k < next; ++k) {
      pivot(a, k, k);
      const Index below = size - k - 1;
      a.col(k).tail(below) /= a(k, k);
      for (Index j = k + 1; j < next; ++j) a.col(j).tail(below) -= a(k, j) * a.col(k).tail(below);
    }
    // The rows of the panel in the columns to its right: a triangle with ones on its diagonal.
    for (Index j = next; j < a.cols(); ++j)
      for (Index k = first; k < next; ++k)
        for (Index i = k + 1; i < next; ++i) a(i, j) -= a(i, k) * a(k, j);
    subtractProduct(a, first, width);
  }
  for (Index k = size - 1; k >= 0; --k) {
    a(k, size) /= a(k, k);
    a.col(size).head(k) -= a(k, size) * a.col(k).head(k);
  }
}

}  // namespace palpa::bem
