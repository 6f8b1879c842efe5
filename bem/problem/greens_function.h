#pragma once

#include <span>
#include <unordered_map>

#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Xi = -A0^-1 Ā0, the discrete Green's function of a reference problem: column j holds the
/// unknowns for a unit value of the known quantity at degree of freedom j. Columns are computed
/// when first asked for and kept. Not thread-safe: one owner fills it.
class GreensFunction {
 public:
  explicit GreensFunction(std::shared_ptr<const ReferenceProblem> problem)
      : problem_(std::move(problem)) {}

  const ReferenceProblem& problem() const { return *problem_; }

  /// Computes those of the columns that are missing, in one block. Costs about two triangular
  /// solves and as many refinement steps as the precision needs, per three columns 0.1 s at 2,500
  /// nodes.
  void ensure(std::span<const int> dofs);
  bool has(int dof) const { return isComplete() || columns_.contains(dof); }

  /// Computes all columns in blocks, unrefined and in single precision (about 1e-5 relative), for
  /// touching anywhere without a solve. Memory: 4 (3n)^2 bytes. Throws Cancelled and keeps what it
  /// had.
  void computeAll(const Job& job);
  bool isComplete() const { return all_.cols() > 0; }

  /// A column (problem().dofs().count() rows); it must be there. A refined column is preferred.
  Eigen::VectorXd column(int dof) const;

  std::size_t bytes() const;

 private:
  std::shared_ptr<const ReferenceProblem> problem_;
  std::unordered_map<int, Eigen::VectorXd> columns_;
  LargeMatrix<float> all_;
};

}  // namespace palpa::bem
