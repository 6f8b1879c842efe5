#include "bem/problem/reference_problem.h"

#include <algorithm>
#include <limits>

namespace palpa::bem {

using Eigen::MatrixXd;

namespace {

/// The residual of fields with a body force; an empty term is zero.
MatrixXd withTerm(MatrixXd residual, const MatrixXd& bodyForceTerm) {
  if (bodyForceTerm.size() > 0) residual += bodyForceTerm;
  return residual;
}

}  // namespace

MatrixXd ReferenceProblem::solve(const BoundaryField& known, Effort effort, const Job& job,
                                 const MatrixXd& bodyForceTerm) const {
  const int rounds = effort == Effort::kRefined ? refinement_.rounds : 1;
  MatrixXd v = MatrixXd::Zero(dofs().count(), known.u.cols());
  BoundaryField field = known;
  double previous = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const MatrixXd rest = withTerm(residual(field, job), bodyForceTerm);
    const MatrixXd step = effort == Effort::kFast    ? fastCorrection(rest, job)
                          : effort == Effort::kRough ? roughCorrection(rest, job)
                                                     : correction(rest, job);
    const double change = step.norm();
    if (!(change < 0.5 * previous)) break;  // refinement has reached the rounding of the residual
    v += step;
    previous = change;
    if (change <= refinement_.change * v.norm() || round + 1 == rounds) break;
    field = dofs().expand(v, MatrixXd());
    field.u += known.u;
    field.p += known.p;
  }
  return v;
}

double ReferenceProblem::relativeResidual(const BoundaryField& field, const Job& job,
                                          const MatrixXd& bodyForceTerm) const {
  const auto largest = [](const MatrixXd& x) -> Eigen::RowVectorXd {
    return x.colwise().lpNorm<Eigen::Infinity>();
  };
  const MatrixXd rest = MatrixXd::Zero(field.u.rows(), field.u.cols());
  const Eigen::RowVectorXd sizes =
      largest(withTerm(residual({rest, field.p}, job), bodyForceTerm)).cwiseMax(1e-300);
  return largest(withTerm(residual(field, job), bodyForceTerm)).cwiseQuotient(sizes).maxCoeff();
}

BoundaryField ReferenceProblem::solveField(const BoundaryField& known, Effort effort,
                                           const Job& job, const MatrixXd& bodyForceTerm) const {
  BoundaryField field = dofs().expand(solve(known, effort, job, bodyForceTerm), MatrixXd());
  field.u += known.u;
  field.p += known.p;
  return field;
}

MatrixXd ReferenceProblem::greensColumns(std::span<const int> columns, Effort effort,
                                         const Job& job) const {
  const auto states = static_cast<Eigen::Index>(columns.size());
  MatrixXd unit = MatrixXd::Zero(dofs().nodalCount(), states);
  for (Eigen::Index k = 0; k < states; ++k) unit(columns[k], k) = 1.0;
  return solve(dofs().expand(MatrixXd::Zero(dofs().count(), states), unit), effort, job);
}

}  // namespace palpa::bem
