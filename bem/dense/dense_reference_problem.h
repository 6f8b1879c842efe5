#pragma once

#include <span>
#include <vector>

#include "bem/linalg/lu_factorisation.h"
#include "bem/problem/reference_problem.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem {

/// y += matrix * x in double precision on the job's threads. Reads only columns whose factors are
/// not zero. Throws Cancelled.
template <class Scalar>
void addProduct(const LargeMatrix<Scalar>& matrix, const Eigen::MatrixXd& x, Eigen::MatrixXd& y,
                const Job& job);

/// Reference problem with operators stored as dense matrices of `Stored` and a system factorised in
/// `Factor`.
template <class Stored, class Factor>
class DenseReferenceProblem final : public ReferenceProblem {
 public:
  DenseReferenceProblem(DegreesOfFreedom dofMap, BoundaryOperators<Stored> operators,
                        const Job& job);
  /// Reads the output of write().
  DenseReferenceProblem(DegreesOfFreedom dofMap, const ByteSource& source);
  void write(const ByteSink& sink) const override;

  const BoundaryOperators<Stored>& operators() const { return operators_; }

  Eigen::MatrixXd residual(const BoundaryField& field, const Job& job) const override;
  Eigen::MatrixXd correction(const Eigen::MatrixXd& r, const Job& job) const override;
  /// Solves A0^T w = r with the factors, without refinement: 1e-4 in single precision.
  Eigen::MatrixXd transposedCorrection(const Eigen::MatrixXd& r) const;
  double conditionEstimate(const Job& job) const override {
    return factors_.conditionEstimate(job);
  }
  std::size_t bytes() const override {
    return operators_.H.bytes() + operators_.G.bytes() + factors_.bytes();
  }

  /// Refinement of every problem with such operators.
  static constexpr Refinement kRefinement{std::is_same_v<Factor, double> ? 2 : 8,
                                          std::is_same_v<Stored, double> ? 1e-13 : 1e-9};

 private:
  BoundaryOperators<Stored> operators_;
  LuFactorisation<Factor> factors_;
};

}  // namespace palpa::bem
