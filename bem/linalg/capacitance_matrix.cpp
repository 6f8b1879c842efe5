#include "bem/linalg/capacitance_matrix.h"

#include "bem/base/error.h"

namespace palpa::bem {

void CapacitanceMatrix::append(const Eigen::MatrixXd& column, const Eigen::MatrixXd& row,
                               const Eigen::MatrixXd& corner) {
  const Eigen::Index s = size(), b = corner.rows();
  const Eigen::MatrixXd inverseColumn = inverse_ * column;  // C^-1 B
  const Eigen::MatrixXd rowInverse = row * inverse_;        // R C^-1
  const Eigen::MatrixXd schur = corner - row * inverseColumn;
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(schur);
  const double smallest = factors.matrixLU().diagonal().cwiseAbs().minCoeff();
  if (!(smallest > 1e-11 * corner.cwiseAbs().maxCoeff()))
    throw SolverError(SolverError::Kind::kSingular,
                      "a contact coincides with others, so its displacement cannot be chosen "
                      "independently. Move it, or remove one of them");
  const Eigen::MatrixXd schurInverse = factors.inverse();

  Eigen::MatrixXd matrix(s + b, s + b), inverse(s + b, s + b);
  matrix << matrix_, column, row, corner;
  inverse.topLeftCorner(s, s) = inverse_ + inverseColumn * schurInverse * rowInverse;
  inverse.topRightCorner(s, b) = -inverseColumn * schurInverse;
  inverse.bottomLeftCorner(b, s) = -schurInverse * rowInverse;
  inverse.bottomRightCorner(b, b) = schurInverse;
  matrix_ = std::move(matrix);
  inverse_ = std::move(inverse);
  refreshIfDrifted();
}

void CapacitanceMatrix::remove(Eigen::Index first, Eigen::Index count) {
  const Eigen::Index after = size() - first - count;
  const auto keep = [&](const Eigen::MatrixXd& full) {
    Eigen::MatrixXd kept(first + after, first + after);
    kept << full.topLeftCorner(first, first), full.topRightCorner(first, after),
        full.bottomLeftCorner(after, first), full.bottomRightCorner(after, after);
    return kept;
  };
  Eigen::MatrixXd right(first + after, count), below(count, first + after);
  right << inverse_.block(0, first, first, count),
      inverse_.block(first + count, first, after, count);
  below << inverse_.block(first, 0, count, first),
      inverse_.block(first, first + count, count, after);
  const Eigen::MatrixXd removed = inverse_.block(first, first, count, count);
  inverse_ = keep(inverse_) - right * removed.fullPivLu().solve(below);
  matrix_ = keep(matrix_);
  refreshIfDrifted();
}

Eigen::VectorXd CapacitanceMatrix::solve(const Eigen::VectorXd& rightHandSide) const {
  Eigen::VectorXd x = inverse_ * rightHandSide;
  x += inverse_ * (rightHandSide - matrix_ * x);
  return x;
}

void CapacitanceMatrix::refreshIfDrifted() {
  if (size() == 0) return;
  const Eigen::VectorXd probe = Eigen::VectorXd::Ones(size());
  const double drift = (matrix_ * (inverse_ * probe) - probe).lpNorm<Eigen::Infinity>();
  if (!(drift < 1e-9)) inverse_ = matrix_.fullPivLu().inverse();
}

}  // namespace palpa::bem
