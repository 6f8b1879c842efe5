#pragma once

#include <memory>
#include <vector>

#include "bem/dense/dense_reference_problem.h"
#include "bem/model/element_part.h"

namespace palpa::bem {

/// Change of operators when some elements move, new minus old: all columns in the rows of some
/// equations, and the columns of the moved elements in the other rows.
template <class Scalar>
struct OperatorChange {
  std::vector<int> equations, others;  ///< ascending; together all equations
  ElementPart moved;
  BoundaryOperators<Scalar> rows;     ///< of `equations`, all columns
  BoundaryOperators<Scalar> columns;  ///< of `others`, for the coefficients and slots of `moved`

  /// Adds the change of G p - H u to a residual.
  void addTo(const BoundaryField& field, Eigen::MatrixXd& residual, const Job& job) const;
  std::size_t bytes() const {
    return rows.H.bytes() + rows.G.bytes() + columns.H.bytes() + columns.G.bytes();
  }
};

/// Dense problem after a change of its operators: A = A0 + Δ. GMRES solves
/// (1 + A0^-1 Δ) v = A0^-1 r and converges in few steps, because Δ has a low rank after a small
/// edit and is small after a small motion.
template <class Stored, class Factor>
class UpdatedReferenceProblem final : public ReferenceProblem {
 public:
  /// `dofs`: the same unknowns and scale of tractions as in `base`.
  UpdatedReferenceProblem(DegreesOfFreedom dofs,
                          std::shared_ptr<const DenseReferenceProblem<Stored, Factor>> base,
                          OperatorChange<Stored> change);

  Eigen::MatrixXd residual(const BoundaryField& field, const Job& job) const override;
  Eigen::MatrixXd correction(const Eigen::MatrixXd& r, const Job& job) const override;
  /// Condition number of the problem whose factors are used.
  double conditionEstimate(const Job& job) const override { return base_->conditionEstimate(job); }
  /// Including `base`.
  std::size_t bytes() const override { return base_->bytes() + change_.bytes(); }
  bool canBeWritten() const override { return false; }
  void write(const ByteSink& sink) const override;

 private:
  /// Δ v
  Eigen::MatrixXd changeOfSystem(const Eigen::MatrixXd& v, const Job& job) const;

  std::shared_ptr<const DenseReferenceProblem<Stored, Factor>> base_;
  OperatorChange<Stored> change_;
};

}  // namespace palpa::bem
