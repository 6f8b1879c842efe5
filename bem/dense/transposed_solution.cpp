#include "bem/dense/transposed_solution.h"

#include <string>
#include <type_traits>

#include "bem/base/error.h"
#include "bem/dense/dense_reference_problem.h"

namespace palpa::bem {

namespace {

/// Calls use(problem) with the type of a dense problem.
template <class Use>
auto withDense(const ReferenceProblem& problem, const Use& use) {
  if (const auto* dense = dynamic_cast<const DenseReferenceProblem<double, double>*>(&problem))
    return use(*dense);
  if (const auto* dense = dynamic_cast<const DenseReferenceProblem<double, float>*>(&problem))
    return use(*dense);
  if (const auto* dense = dynamic_cast<const DenseReferenceProblem<float, float>*>(&problem))
    return use(*dense);
  if (problem.storageName() == "compressed")
    throw SolverError(SolverError::Kind::kTooLarge,
                      "gradients need dense operators; this model of " +
                          std::to_string(problem.dofs().nodeCount()) +
                          " nodes is compressed: take a coarser mesh");
  throw SolverError(SolverError::Kind::kBadCondition,
                    "gradients need a full rebuild; this model is an incremental update");
}

}  // namespace

Eigen::MatrixXd solveTransposed(const ReferenceProblem& problem, const Eigen::MatrixXd& r) {
  return withDense(problem, [&](const auto& dense) { return dense.transposedCorrection(r); });
}

Eigen::VectorXd transposedTractions(const ReferenceProblem& problem,
                                    const Eigen::VectorXd& lambda) {
  return withDense(problem, [&](const auto& dense) -> Eigen::VectorXd {
    const auto& matrix = dense.operators().G;
    using Scalar = std::remove_cvref_t<decltype(*matrix.data())>;
    const Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>> G(
        matrix.data(), matrix.rows(), matrix.cols());
    return (G.transpose() * lambda.cast<Scalar>()).template cast<double>();
  });
}

Eigen::MatrixXd derivativeByUnknowns(const DegreesOfFreedom& dofs, const Eigen::MatrixXd& psi) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dofs.count(), psi.cols());
  for (int dof = 0; dof < dofs.nodalCount(); ++dof)
    if (!dofs.isConstrained(dof))
      result.row(dof) =
          dofs.frame(dof / 3).col(dof % 3).transpose() * psi.middleRows<3>(3 * (dof / 3));
  return result;
}

}  // namespace palpa::bem
