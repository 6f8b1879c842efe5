#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bem/compressed/compressed_operators.h"
#include "bem/compressed/tile_lu.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Errors of compressed problems; smaller ones take more memory and time.
struct CompressionOptions {
  /// Of the blocks of the operators, relative.
  double operators = 3e-5;
  /// Of the factorisation that GMRES is preconditioned with, relative.
  double factors = 1e-3;
  int tileNodes = 0;  ///< nodes per tile of the factorisation, at least; 0: chosen by size
};

/// Reference problem with compressed operators and an approximate factorisation of the system,
/// which preconditions GMRES. Solves the equations of the compressed operators to kTolerance.
class CompressedReferenceProblem final : public ReferenceProblem {
 public:
  CompressedReferenceProblem(DegreesOfFreedom dofMap, CompressedOperators operators,
                             const CompressionOptions& options, const Job& job);

  const CompressedOperators& operators() const { return operators_; }
  const TileLu& factors() const { return *factors_; }

  Eigen::MatrixXd residual(const BoundaryField& field, const Job& job) const override;
  /// By GMRES. Throws SolverError (kBadCondition) if it does not converge.
  Eigen::MatrixXd correction(const Eigen::MatrixXd& r, const Job& job) const override;
  /// Of the approximate factorisation.
  double conditionEstimate(const Job& job) const override;
  std::size_t bytes() const override { return operators_.bytes() + factors_->bytes(); }
  std::string_view storageName() const override { return "compressed"; }
  bool canBeWritten() const override { return false; }
  /// Throws std::logic_error: compressed problems are not stored.
  void write(const ByteSink& sink) const override;

  /// Residual of a correction over its right-hand side.
  static constexpr double kTolerance = 1e-5;

 private:
  Eigen::MatrixXd precondition(const Eigen::MatrixXd& r, const Job& job) const;

  CompressedOperators operators_;
  std::vector<int> equations_;  ///< in the order of the tiles
  std::unique_ptr<TileLu> factors_;
};

}  // namespace palpa::bem
