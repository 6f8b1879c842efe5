#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// A problem whose rough solutions are 5 % too large.
class RoughlySolved final : public ReferenceProblem {
 public:
  static constexpr double kFactor = 1.05;

  explicit RoughlySolved(std::shared_ptr<const ReferenceProblem> exact)
      : ReferenceProblem(exact->dofs(), {1, 0}), exact_(std::move(exact)) {}

  Eigen::MatrixXd residual(const BoundaryField& field, const Job& job) const override {
    return exact_->residual(field, job);
  }
  Eigen::MatrixXd correction(const Eigen::MatrixXd& residual, const Job& job) const override {
    return exact_->correction(residual, job);
  }
  Eigen::MatrixXd roughCorrection(const Eigen::MatrixXd& residual, const Job& job) const override {
    ++roughCount_;
    return kFactor * exact_->correction(residual, job);
  }
  bool hasRoughSolution() const override { return true; }
  double conditionEstimate(const Job& job) const override { return exact_->conditionEstimate(job); }
  std::size_t bytes() const override { return exact_->bytes(); }
  bool canBeWritten() const override { return false; }
  void write(const ByteSink&) const override { throw std::logic_error("cannot be stored"); }

  /// Number of calls of roughCorrection().
  int roughCount() const { return roughCount_; }

 private:
  std::shared_ptr<const ReferenceProblem> exact_;
  mutable std::atomic<int> roughCount_{0};
};

}  // namespace palpa::bem
