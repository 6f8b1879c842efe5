#include "written_out.h"

namespace palpa::bem::test {

using Eigen::VectorXd;

WrittenOut::WrittenOut(const BoundaryOperators<double>& operators, const DegreesOfFreedom& dofs) {
  A.resize(dofs.count(), dofs.count());
  ABar = Eigen::MatrixXd::Zero(dofs.count(), dofs.nodalCount());
  for (int dof = 0; dof < dofs.count(); ++dof) {
    VectorXd traction = VectorXd::Zero(dofs.count());
    for (const auto& w : dofs.tractionOf(dof))
      for (int i = 0; i < 3; ++i)
        traction -= w.traction[i] * operators.G.view().col(3 * w.slot + i);
    if (dof >= dofs.nodalCount()) {
      A.col(dof) = traction;
      continue;
    }
    VectorXd displacement = VectorXd::Zero(dofs.count());
    for (int i = 0; i < 3; ++i)
      displacement += dofs.frame(dof / 3)(i, dof % 3) * operators.H.view().col(3 * (dof / 3) + i);
    A.col(dof) = dofs.isConstrained(dof) ? traction : displacement;
    ABar.col(dof) = dofs.isConstrained(dof) ? displacement : traction;
  }
}

VectorXd WrittenOut::solveSwitched(const std::vector<int>& nodes, const VectorXd& known) const {
  Eigen::MatrixXd a = A, aBar = ABar;
  for (const int node : nodes)
    for (int k = 0; k < 3; ++k) a.col(3 * node + k).swap(aBar.col(3 * node + k));
  return a.partialPivLu().solve(-aBar * known);
}

}  // namespace palpa::bem::test
