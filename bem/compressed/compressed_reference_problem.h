#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "bem/compressed/compressed_operators.h"
#include "bem/compressed/tile_lu.h"
#include "bem/problem/greens_columns.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Errors of compressed problems; smaller ones take more memory and time.
struct CompressionOptions {
  /// Of the blocks of the operators, relative; the rounding of the stored numbers remains below it.
  /// 0: chosen, see operatorTolerance().
  double operators = 0;
  /// Of the factorisation that GMRES is preconditioned with, relative.
  double factors = 1e-3;
  int tileNodes = 0;  ///< nodes per tile of the factorisation, at least; 0: chosen by size
};

/// Reference problem with compressed operators and an approximate factorisation of the system,
/// which preconditions GMRES. Solves the equations of the compressed operators to kTolerance.
///
/// A member of a team has the operators of its share and the whole factorisation: residual() is a
/// summand of the team's, and correction() must not be called.
class CompressedReferenceProblem final : public ReferenceProblem {
 public:
  /// `team`: of members with shares of the operators, who factorise together.
  CompressedReferenceProblem(DegreesOfFreedom dofMap, CompressedOperators operators,
                             const CompressionOptions& options, const Job& job,
                             const Team* team = nullptr);

  /// Reads what write() wrote. Throws DamagedData, and what the source throws.
  CompressedReferenceProblem(DegreesOfFreedom dofMap, const ByteSource& source);

  const CompressedOperators& operators() const { return operators_; }
  const TileLu& factors() const { return *factors_; }

  Eigen::MatrixXd residual(const BoundaryField& field, const Job& job) const override;
  /// By GMRES. Throws SolverError (kBadCondition) if it does not converge.
  Eigen::MatrixXd correction(const Eigen::MatrixXd& r, const Job& job) const override;
  /// The factorisation's solution, in most cases corrected once: half of the operations of GMRES.
  Eigen::MatrixXd fastCorrection(const Eigen::MatrixXd& r, const Job& job) const override;
  /// The factorisation's solution alone.
  Eigen::MatrixXd roughCorrection(const Eigen::MatrixXd& r, const Job& job) const override {
    return precondition(r, job);
  }
  bool hasRoughSolution() const override { return true; }
  /// Unknowns by the approximate factorisation, without GMRES.
  Eigen::MatrixXd precondition(const Eigen::MatrixXd& residual, const Job& job) const;
  /// Of the approximate factorisation.
  double conditionEstimate(const Job& job) const override;
  std::size_t bytes() const override {
    return operators_.bytes() + factors_->bytes() +
           static_cast<std::size_t>(knownColumns_.values.size()) * sizeof(float);
  }
  std::string_view storageName() const override { return "compressed"; }
  void write(const ByteSink& sink) const override;

  /// Columns that are stored with the problem, for makeGreensColumns().
  const KnownColumns& knownColumns() const { return knownColumns_; }
  void setKnownColumns(KnownColumns columns) { knownColumns_ = std::move(columns); }

  /// Adds the operators of another member of the team.
  void add(CompressedOperators share) { operators_.add(std::move(share)); }

  static constexpr Refinement kRefinement{3, 1e-7};
  /// Residual of a correction over its right-hand side.
  static constexpr double kTolerance = 1e-5;

 private:
  CompressedOperators operators_;
  std::vector<int> equations_;  ///< in the order of the tiles
  std::unique_ptr<TileLu> factors_;
  KnownColumns knownColumns_;
};

/// Columns of a problem, those that are stored with it already available. Throws SolverError as the
/// constructor.
std::shared_ptr<GreensColumns> makeGreensColumns(std::shared_ptr<const ReferenceProblem> problem);

}  // namespace palpa::bem
