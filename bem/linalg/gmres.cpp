#include "bem/linalg/gmres.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Small least-squares problem of one column: its Hessenberg matrix, which Givens rotations make
/// triangular while it grows.
class HessenbergColumn {
 public:
  HessenbergColumn(double norm, int maxSteps)
      : norm_(norm), triangle_(maxSteps + 1, maxSteps), right_(VectorXd::Zero(maxSteps + 1)) {
    right_[0] = norm;
  }

  /// Norm of the residual divided by the norm of b.
  double residual() const { return norm_ > 0 ? std::abs(right_[steps_]) / norm_ : 0; }

  /// Appends a column: the projections on the basis and the norm of the rest, steps + 2 numbers.
  void add(VectorXd column) {
    for (int k = 0; k < steps_; ++k) rotate(rotations_[k], column[k], column[k + 1]);
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(column[steps_], column[steps_ + 1]);
    rotation = rotation.adjoint();
    rotate(rotation, column[steps_], column[steps_ + 1]);
    rotate(rotation, right_[steps_], right_[steps_ + 1]);
    rotations_.push_back(rotation);
    triangle_.col(steps_).head(steps_ + 1) = column.head(steps_ + 1);
    ++steps_;
  }

  /// Coefficients of the solution in the basis.
  VectorXd solution() const {
    return triangle_.topLeftCorner(steps_, steps_)
        .triangularView<Eigen::Upper>()
        .solve(right_.head(steps_));
  }

 private:
  static void rotate(const Eigen::JacobiRotation<double>& r, double& a, double& b) {
    const double first = r.c() * a + r.s() * b;
    b = -r.s() * a + r.c() * b;
    a = first;
  }

  double norm_;
  int steps_ = 0;
  MatrixXd triangle_;
  VectorXd right_;
  std::vector<Eigen::JacobiRotation<double>> rotations_;
};

}  // namespace

GmresSolution gmres(const std::function<MatrixXd(const MatrixXd&)>& apply, const MatrixXd& b,
                    double tolerance, int maxSteps, const Job& job) {
  const Eigen::RowVectorXd norms = b.colwise().norm();
  std::vector<MatrixXd> basis{b * norms.cwiseMax(1e-300).cwiseInverse().asDiagonal()};
  std::vector<HessenbergColumn> columns;
  for (Index c = 0; c < b.cols(); ++c) columns.emplace_back(norms[c], maxSteps);
  const auto isDone = [&](const HessenbergColumn& column) {
    return column.residual() <= tolerance;
  };
  GmresSolution result;
  while (result.steps < maxSteps && !std::all_of(columns.begin(), columns.end(), isDone)) {
    job.throwIfCancelled();
    MatrixXd next = apply(basis.back());
    ++result.steps;
    for (Index c = 0; c < b.cols(); ++c) {
      auto column = next.col(c);
      if (isDone(columns[c])) {  // its space is not extended any more
        column.setZero();
        continue;
      }
      VectorXd projections(basis.size() + 1);
      for (std::size_t k = 0; k < basis.size(); ++k) {
        projections[static_cast<Index>(k)] = basis[k].col(c).dot(column);
        column -= projections[static_cast<Index>(k)] * basis[k].col(c);
      }
      const double left = column.norm();
      projections[static_cast<Index>(basis.size())] = left;
      columns[c].add(std::move(projections));
      column /= std::max(left, 1e-300);
    }
    basis.push_back(std::move(next));
  }
  result.x = MatrixXd::Zero(b.rows(), b.cols());
  for (Index c = 0; c < b.cols(); ++c) {
    const VectorXd factors = columns[c].solution();
    for (Index k = 0; k < factors.size(); ++k)
      result.x.col(c) += factors[k] * basis[static_cast<std::size_t>(k)].col(c);
    result.residual = std::max(result.residual, columns[c].residual());
  }
  return result;
}

}  // namespace palpa::bem
