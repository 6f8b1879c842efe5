#include "bem/reference_problem.h"

namespace palpa::bem {

BoundaryField ReferenceProblem::solveField(const BoundaryField& known, Effort effort,
                                           const Job& job) const {
  BoundaryField field = dofs().expand(solve(known, effort, job), Eigen::MatrixXd());
  field.u += known.u;
  field.p += known.p;
  return field;
}

Eigen::MatrixXd ReferenceProblem::greensColumns(std::span<const int> columns, Effort effort,
                                                const Job& job) const {
  const auto states = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(dofs().nodalCount(), states);
  for (Eigen::Index k = 0; k < states; ++k) unit(columns[k], k) = 1.0;
  return solve(dofs().expand(Eigen::MatrixXd::Zero(dofs().count(), states), unit), effort, job);
}

Precision choosePrecision(Precision wanted, int nodeCount) {
  // Double factors cost twice the time of single ones; below this they still come well within the
  // rebuild budget of a small body.
  constexpr int kDoubleUpTo = 800;
  if (wanted != Precision::kAutomatic) return wanted;
  return nodeCount <= kDoubleUpTo ? Precision::kDouble : Precision::kSingle;
}

double estimateBytes(int nodeCount, int slotCount, Precision precision) {
  const Precision chosen = choosePrecision(precision, nodeCount);
  const double n = 3.0 * nodeCount, q = 3.0 * slotCount;
  const double stored = chosen == Precision::kSingle ? 4 : 8;
  const double factor = chosen == Precision::kDouble ? 8 : 4;
  return n * (n * stored + q * stored + n * factor);
}

}  // namespace palpa::bem
