#pragma once

#include <memory>

#include "app/mpi/mpi_team.h"
#include "bem/compressed/compressed_reference_problem.h"

namespace palpa::mpi {

/// Compressed problem whose operators are divided among the ranks. All functions are collective,
/// with the same arguments on all ranks, and give the same result on all: each rank multiplies with
/// its blocks, and preconditions its share of the right-hand sides with the whole factors.
class SharedProblem final : public bem::ReferenceProblem {
 public:
  /// `share`: made by all ranks together. `team` must outlive it.
  SharedProblem(std::unique_ptr<bem::CompressedReferenceProblem> share, const MpiTeam& team);

  Eigen::MatrixXd residual(const bem::BoundaryField& field, const Job& job) const override;
  /// By PETSc's GMRES. Throws SolverError (kBadCondition) if it does not converge.
  Eigen::MatrixXd correction(const Eigen::MatrixXd& r, const Job& job) const override;
  double conditionEstimate(const Job& job) const override { return share_->conditionEstimate(job); }
  /// Of this rank.
  std::size_t bytes() const override { return share_->bytes(); }
  std::size_t operatorBytes() const { return share_->operators().bytes(); }
  std::string_view storageName() const override { return "compressed"; }
  bool canBeWritten() const override { return false; }
  /// Throws std::logic_error.
  void write(const ByteSink& sink) const override;

  /// Brings the operators of all ranks to rank 0. There the result is the whole problem, elsewhere
  /// null. No other function may be called afterwards.
  std::unique_ptr<bem::CompressedReferenceProblem> whole();

 private:
  /// Columns of a rank among `all`.
  struct Columns {
    Eigen::Index begin, count;
  };
  Columns columnsOf(int rank, Eigen::Index all) const;
  Eigen::MatrixXd apply(const Eigen::MatrixXd& own, Eigen::Index all, const Job& job) const;
  Eigen::MatrixXd allColumns(const Eigen::MatrixXd& own, Eigen::Index all) const;

  std::unique_ptr<bem::CompressedReferenceProblem> share_;
  const MpiTeam& team_;
};

}  // namespace palpa::mpi
