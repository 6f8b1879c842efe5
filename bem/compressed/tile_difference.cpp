#include "bem/compressed/tile_difference.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

/// Random vectors that a basis begins with, those that are added while it does not suffice, and
/// the last ones of these that test it.
constexpr int kSampleColumns = 32, kMoreColumns = 16, kTestColumns = 6;

/// S^T x for a factor R S^T, or x under a dense factor.
MatrixXf under(const LowRankTile& factor, const MatrixXf& x) {
  MatrixXf result;
  if (factor.isDense())
    multiply(false, false, 1, factor.X, x, 0, result);
  else if (!factor.isZero())
    multiply(true, false, 1, factor.Y, x, 0, result);
  return result;
}

}  // namespace

void SharedFactors::draw(Index columns, unsigned seed) {
  random = randomMatrix(columns, kSampleColumns, seed);
  onRandom.clear();
  for (const LowRankTile& factor : factors) onRandom.push_back(under(factor, random));
}

TileDifference::TileDifference(LowRankTile base, std::vector<LowRankTile> left,
                               const SharedFactors& right, const Job& job)
    : base_(std::move(base)),
      left_(std::move(left)),
      right_(right),
      job_(job),
      middles_(left_.size()) {
  for (std::size_t m = 0; m < left_.size(); ++m) {
    LowRankTile& A = left_[m];
    const LowRankTile& B = right_.factors[m];
    if (B.isZero()) A = {};
    if (!A.isZero() && !A.isDense() && !B.isDense())
      multiply(true, false, 1, A.Y, B.X, 0, middles_[m]);
  }
}

MatrixXf TileDifference::sample(const MatrixXf& x, const std::vector<MatrixXf>& onRight) const {
  MatrixXf y, inner = under(base_, x);
  if (base_.isDense())
    y = std::move(inner);
  else
    multiply(false, false, 1, base_.X, inner, 0, y);
  for (std::size_t m = 0; m < left_.size(); ++m) {
    job_.throwIfCancelled();
    const LowRankTile &A = left_[m], &B = right_.factors[m];
    if (A.isZero()) continue;
    const MatrixXf* last = &inner;  // before the left factor of A
    if (middles_[m].size() > 0)
      multiply(false, false, 1, middles_[m], onRight[m], 0, inner);
    else if (!A.isDense())
      multiply(true, false, 1, A.Y, onRight[m], 0, inner);
    else if (!B.isDense())
      multiply(false, false, 1, B.X, onRight[m], 0, inner);
    else
      last = &onRight[m];
    multiply(false, false, -1, A.X, *last, 1, y);
  }
  return y;
}

MatrixXf TileDifference::sampleTransposed(const MatrixXf& x) const {
  MatrixXf y, first, second;
  multiply(true, false, 1, base_.X, x, 0, first);
  if (base_.isDense())
    y = std::move(first);
  else
    multiply(false, false, 1, base_.Y, first, 0, y);
  for (std::size_t m = 0; m < left_.size(); ++m) {
    job_.throwIfCancelled();
    const LowRankTile &A = left_[m], &B = right_.factors[m];
    if (A.isZero()) continue;
    multiply(true, false, 1, A.X, x, 0, first);
    const MatrixXf* last = &second;  // before the right factor of B, transposed
    if (middles_[m].size() > 0)
      multiply(true, false, 1, middles_[m], first, 0, second);
    else if (!B.isDense())
      multiply(true, false, 1, B.X, first, 0, second);
    else if (!A.isDense())
      multiply(false, false, 1, A.Y, first, 0, second);
    else
      last = &first;
    multiply(B.isDense(), false, -1, B.isDense() ? B.X : B.Y, *last, 1, y);
  }
  return y;
}

MatrixXf TileDifference::dense() && {
  MatrixXf result = toDense(std::move(base_)), left, inner;
  for (std::size_t m = 0; m < left_.size(); ++m) {
    job_.throwIfCancelled();
    const LowRankTile &A = left_[m], &B = right_.factors[m];
    if (A.isZero()) continue;
    if (B.isDense() && !A.isDense()) {
      multiply(true, false, 1, A.Y, B.X, 0, inner);
      multiply(false, false, -1, A.X, inner, 1, result);
      continue;
    }
    multiply(false, false, 1, A.X, middles_[m].size() > 0 ? middles_[m] : B.X, 0, left);
    if (B.isDense())
      result -= left;
    else
      multiply(false, true, -1, left, B.Y, 1, result);
  }
  return result;
}

LowRankTile TileDifference::compress(float tolerance, unsigned seed) && {
  const Index rows = base_.X.rows(), columns = right_.random.rows(),
              most = std::min(rows, columns) / 3;
  MatrixXf basis(rows, 0), projections;
  const auto subtractBasis = [&](MatrixXf& from) {
    if (basis.cols() == 0) return;
    multiply(true, false, 1, basis, from, 0, projections);
    multiply(false, false, -1, basis, projections, 1, from);
  };
  const auto append = [&](MatrixXf directions) {
    orthonormalise(directions);
    subtractBasis(directions);  // orthogonal to rounding
    orthonormalise(directions);
    const Index before = basis.cols();
    basis.conservativeResize(Eigen::NoChange, before + directions.cols());
    basis.rightCols(directions.cols()) = directions;
  };
  MatrixXf samples = sample(right_.random, right_.onRandom);
  for (;;) {
    if (basis.cols() + samples.cols() > most) return {std::move(*this).dense(), {}};
    subtractBasis(samples);
    append(samples.leftCols(samples.cols() - kTestColumns));
    MatrixXf test = samples.rightCols(kTestColumns);
    subtractBasis(test);
    if (test.norm() < tolerance * std::sqrt(static_cast<float>(kTestColumns))) break;
    append(std::move(test));
    const MatrixXf x = randomMatrix(columns, kMoreColumns, ++seed);
    std::vector<MatrixXf> onRight;
    for (const LowRankTile& factor : right_.factors) onRight.push_back(under(factor, x));
    samples = sample(x, onRight);
  }
  const MatrixXf onBasis = sampleTransposed(basis);  // (columns, basis)
  MatrixXf squares;
  multiply(true, false, 1, onBasis, onBasis, 0, squares);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(squares.cast<double>());
  // Singular values ascend.
  Index first = 0;
  double leftOut = 0;
  const double limit = static_cast<double>(tolerance) * tolerance;
  while (first < basis.cols() && leftOut + std::max(eigen.eigenvalues()[first], 0.0) < limit)
    leftOut += std::max(eigen.eigenvalues()[first++], 0.0);
  const MatrixXf turn = eigen.eigenvectors().rightCols(basis.cols() - first).cast<float>();
  LowRankTile result;
  multiply(false, false, 1, basis, turn, 0, result.X);
  multiply(false, false, 1, onBasis, turn, 0, result.Y);
  return result;
}

}  // namespace palpa::bem
