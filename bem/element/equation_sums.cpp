#include "bem/element/equation_sums.h"

#include <algorithm>

#include "base/parallel.h"
#include "bem/model/element_part.h"

namespace palpa::bem {

using Eigen::Index;

template <class Scalar>
PointWeights<Scalar>::PointWeights(const Eigen::SparseMatrix<double>& all, Index first,
                                   Index count) {
  for (Index k = 0; k < count; ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator w(all, first + k); w; ++w)
      equations_.push_back(w.row());
  std::sort(equations_.begin(), equations_.end());
  equations_.erase(std::unique(equations_.begin(), equations_.end()), equations_.end());
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (Index k = 0; k < count; ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator w(all, first + k); w; ++w)
      entries.emplace_back(
          static_cast<int>(std::lower_bound(equations_.begin(), equations_.end(), w.row()) -
                           equations_.begin()),
          static_cast<int>(k), static_cast<Scalar>(w.value()));
  weights_.resize(static_cast<Index>(equations_.size()), count);
  weights_.setFromTriplets(entries.begin(), entries.end());
}

template <class Scalar>
void PointWeights<Scalar>::add(const LargeMatrix<Scalar>& ofPoints, Index firstColumn,
                               LargeMatrix<Scalar>& ofEquations) const {
  using Panel = Eigen::Matrix<Scalar, Eigen::Dynamic, kColumns, Eigen::RowMajor>;
  const Index points = weights_.cols(), equations = ofEquations.rows() / 3,
              columns = std::min<Index>(kColumns, ofPoints.cols() - firstColumn);
  Panel values = Panel::Zero(points, kColumns), sums(weights_.rows(), kColumns);
  for (int i = 0; i < 3; ++i) {
    values.leftCols(columns) = ofPoints.view().block(i * points, firstColumn, points, columns);
    sums.noalias() = weights_ * values;
    for (Index c = 0; c < columns; ++c) {
      Scalar* to = ofEquations.data() + (firstColumn + c) * ofEquations.rows() + i * equations;
      for (std::size_t e = 0; e < equations_.size(); ++e)
        to[equations_[e]] += sums(static_cast<Index>(e), c);
    }
  }
}

template <class Scalar>
BlockScatter<Scalar>::BlockScatter(std::span<const int> functions, Index equationCount)
    : columns_(placesIn(functions, functions.empty() ? 0 : functions.back() + 1)),
      sources_(functions.size()),
      equationCount_(equationCount) {}

template <class Scalar>
void BlockScatter<Scalar>::add(std::span<const Part> parts, const Job& job,
                               LargeMatrix<Scalar>& matrix) {
  constexpr std::ptrdiff_t kColumnsPerTask = 32;
  for (auto& sources : sources_) sources.clear();
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t f = 0; f < parts[p].functions->size(); ++f)
      sources_[columns_[(*parts[p].functions)[f]]].push_back(
          {static_cast<int>(p), static_cast<int>(f)});
  const auto count = static_cast<std::ptrdiff_t>(sources_.size());
  parallelFor((count + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t task) {
    const std::ptrdiff_t end = std::min(count, (task + 1) * kColumnsPerTask);
    for (std::ptrdiff_t k = task * kColumnsPerTask; k < end; ++k)
      for (int c = 0; c < 3; ++c) {
        Scalar* column = matrix.data() + (3 * k + c) * matrix.rows();
        for (const auto& [p, f] : sources_[k]) {
          const std::vector<int>& equations = *parts[p].equations;
          const double* from = parts[p].block->col(3 * f + c).data();
          for (std::size_t e = 0; e < equations.size(); ++e)
            for (int i = 0; i < 3; ++i)
              column[i * equationCount_ + equations[e]] += static_cast<Scalar>(from[3 * e + i]);
        }
      }
  });
}

template class PointWeights<double>;
template class PointWeights<float>;
template class BlockScatter<double>;
template class BlockScatter<float>;

}  // namespace palpa::bem
