#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "base/byte_stream.h"
#include "base/job.h"
#include "bem/model/boundary_conditions.h"
#include "bem/problem/problem_inputs.h"

namespace palpa::bem {

/// Mixed boundary value problem whose solution operator is computed once and then used for every
/// touch (the reference boundary value problem of James & Pai): A0 v + Ā0 v̄ = 0 in the unknowns and
/// known values of `DegreesOfFreedom`. Assumes nothing about the storage of H, G and A0. Immutable;
/// several threads may call all members.
class ReferenceProblem {
 public:
  virtual ~ReferenceProblem() = default;

  const DegreesOfFreedom& dofs() const { return dofs_; }

  enum class Effort { kRefined, kFast, kRough };
  /// Unknowns v (dofs().count() rows) for known fields, one column each: A0 v = G p - H u + term.
  /// kRefined iterates on the residual in double precision until it stops falling; kFast takes the
  /// result of the factorisation, with an error below some 1e-4; kRough is for a force that is
  /// wanted at once, see hasRoughSolution().
  /// `bodyForceTerm`: Discretisation::bodyForceTerm() of each column; empty if there is no body
  /// force. Throws Cancelled.
  Eigen::MatrixXd solve(const BoundaryField& known, Effort effort = Effort::kRefined,
                        const Job& job = {}, const Eigen::MatrixXd& bodyForceTerm = {}) const;

  /// G p - H u of a field, in double precision. Throws Cancelled.
  virtual Eigen::MatrixXd residual(const BoundaryField& field, const Job& job = {}) const = 0;

  /// Unknowns that cancel a residual G p - H u: A0 v = residual, with the rows of the operators,
  /// solved by the factorisation without refinement. Throws Cancelled.
  virtual Eigen::MatrixXd correction(const Eigen::MatrixXd& residual,
                                     const Job& job = {}) const = 0;
  /// correction() with the error of Effort::kFast.
  virtual Eigen::MatrixXd fastCorrection(const Eigen::MatrixXd& residual, const Job& job) const {
    return correction(residual, job);
  }
  /// correction() with the error of Effort::kRough.
  virtual Eigen::MatrixXd roughCorrection(const Eigen::MatrixXd& residual, const Job& job) const {
    return fastCorrection(residual, job);
  }
  /// True if Effort::kRough is quicker than kFast, and has larger errors: some 1e-2 in fields,
  /// 1e-5 to 1e-3 in forces.
  virtual bool hasRoughSolution() const { return false; }

  /// The whole field: known plus unknown part.
  BoundaryField solveField(const BoundaryField& known, Effort effort = Effort::kRefined,
                           const Job& job = {}, const Eigen::MatrixXd& bodyForceTerm = {}) const;

  /// Columns of Xi = -A0^-1 Ā0 for the given nodal degrees of freedom: the unknowns for a unit
  /// known value. Throws Cancelled.
  Eigen::MatrixXd greensColumns(std::span<const int> columns, Effort effort = Effort::kRefined,
                                const Job& job = {}) const;

  /// max |G p - H u + term| / max |G p + term|, the largest of all columns: how well fields fulfil
  /// the equations.
  double relativeResidual(const BoundaryField& field, const Job& job = {},
                          const Eigen::MatrixXd& bodyForceTerm = {}) const;
  /// Condition number of A0 in the 1-norm; costs about as much as five columns. Throws Cancelled.
  virtual double conditionEstimate(const Job& job = {}) const = 0;
  virtual std::size_t bytes() const = 0;

  /// How the operators are stored, for reports: "dense", "compressed".
  virtual std::string_view storageName() const { return "dense"; }
  /// False if the problem cannot be stored: write() throws.
  virtual bool canBeWritten() const { return true; }
  /// Writes the operators and factors bit by bit, in the byte order of this machine. Throws
  /// std::logic_error if the problem cannot be stored.
  virtual void write(const ByteSink& sink) const = 0;

 protected:
  /// Refinement ends after `rounds`, when the unknowns change by less than `change` (relative), or
  /// when the residual no longer falls.
  struct Refinement {
    int rounds;
    double change;
  };
  ReferenceProblem(DegreesOfFreedom dofs, Refinement refinement)
      : dofs_(std::move(dofs)), refinement_(refinement) {}
  const Refinement& refinement() const { return refinement_; }

 private:
  DegreesOfFreedom dofs_;
  Refinement refinement_;
};

}  // namespace palpa::bem
