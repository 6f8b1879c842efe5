#pragma once

#include <memory>
#include <span>

#include "base/byte_stream.h"
#include "bem/model/boundary_conditions.h"
#include "bem/problem/problem_inputs.h"

namespace palpa::bem {

/// The mixed boundary value problem whose solution operator is computed once and then touched (the
/// seed's RBVP): A0 v + Ā0 v̄ = 0 in the degrees of freedom of `DegreesOfFreedom`. This interface
/// assumes nothing of how H, G or A0 are stored. Immutable after construction; all members may be
/// called from several threads.
class ReferenceProblem {
 public:
  virtual ~ReferenceProblem() = default;

  const DegreesOfFreedom& dofs() const { return dofs_; }

  enum class Effort { kRefined, kFast };
  /// Unknowns v (dofs().count() rows) for known fields, one column each: A0 v = G p - H u. kRefined
  /// iterates on the residual in double precision until it stops falling; kFast takes the
  /// factorisation's answer as it is.
  /// Throws Cancelled on stop.
  Eigen::MatrixXd solve(const BoundaryField& known, Effort effort = Effort::kRefined,
                        const Job& job = {}) const;

  /// G p - H u of a field, in double precision. Throws Cancelled on stop.
  virtual Eigen::MatrixXd residual(const BoundaryField& field, const Job& job = {}) const = 0;

  /// The unknowns that take away a residual G p - H u: A0 v = residual, whose rows are those of the
  /// operators, with the factorisation as it is. Throws Cancelled on stop.
  virtual Eigen::MatrixXd correction(const Eigen::MatrixXd& residual,
                                     const Job& job = {}) const = 0;

  /// The whole field: known plus unknown part.
  BoundaryField solveField(const BoundaryField& known, Effort effort = Effort::kRefined,
                           const Job& job = {}) const;

  /// Columns of Xi = -A0^-1 Ā0 for the given nodal degrees of freedom: the unknowns for a unit
  /// known value. Throws Cancelled on stop.
  Eigen::MatrixXd greensColumns(std::span<const int> columns, Effort effort = Effort::kRefined,
                                const Job& job = {}) const;

  /// max norm of G p - H u relative to that of G p, the largest of all columns: how well fields
  /// fulfil the equations.
  double relativeResidual(const BoundaryField& field, const Job& job = {}) const;
  /// Of A0 in the 1-norm; costs about as much as five columns. Throws Cancelled on stop.
  virtual double conditionEstimate(const Job& job = {}) const = 0;
  virtual std::size_t bytes() const = 0;

  /// Writes the operators and factors bit by bit, in the byte order of this machine. Throws
  /// std::logic_error if the problem cannot be stored.
  virtual void write(const ByteSink& sink) const = 0;

 protected:
  /// When refinement ends, unless it stops getting better: after so many rounds, or when the
  /// unknowns change by so little (relative).
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
