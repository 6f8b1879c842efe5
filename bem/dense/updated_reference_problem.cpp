#include "bem/dense/updated_reference_problem.h"

#include <stdexcept>

#include "bem/linalg/gmres.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Three rows per index.
MatrixXd rowsOf(const MatrixXd& x, const std::vector<int>& indices) {
  MatrixXd some(3 * static_cast<Index>(indices.size()), x.cols());
  for (std::size_t k = 0; k < indices.size(); ++k)
    some.middleRows<3>(3 * static_cast<Index>(k)) = x.middleRows<3>(3 * indices[k]);
  return some;
}

template <class Scalar>
void addProducts(const BoundaryOperators<Scalar>& operators, const MatrixXd& u, const MatrixXd& p,
                 const std::vector<int>& equations, MatrixXd& residual, const Job& job) {
  const Index count = residual.rows() / 3, some = static_cast<Index>(equations.size());
  if (some == 0) return;
  MatrixXd product = MatrixXd::Zero(3 * some, residual.cols());
  addProduct<Scalar>(operators.H, -u, product, job);
  addProduct<Scalar>(operators.G, p, product, job);
  for (int c = 0; c < 3; ++c)
    for (Index k = 0; k < some; ++k)
      residual.row(c * count + equations[k]) += product.row(c * some + k);
}

}  // namespace

template <class Scalar>
void OperatorChange<Scalar>::addTo(const BoundaryField& field, MatrixXd& residual,
                                   const Job& job) const {
  addProducts(rows, field.u, field.p, equations, residual, job);
  addProducts(columns, rowsOf(field.u, moved.coefficients), rowsOf(field.p, moved.slots), others,
              residual, job);
}

template <class Stored, class Factor>
UpdatedReferenceProblem<Stored, Factor>::UpdatedReferenceProblem(
    DegreesOfFreedom dofs, std::shared_ptr<const DenseReferenceProblem<Stored, Factor>> base,
    OperatorChange<Stored> change)
    : ReferenceProblem(std::move(dofs),
                       {8, DenseReferenceProblem<Stored, Factor>::kRefinement.change}),
      base_(std::move(base)),
      change_(std::move(change)) {}

template <class Stored, class Factor>
MatrixXd UpdatedReferenceProblem<Stored, Factor>::residual(const BoundaryField& field,
                                                           const Job& job) const {
  MatrixXd r = base_->residual(field, job);
  change_.addTo(field, r, job);
  return r;
}

template <class Stored, class Factor>
MatrixXd UpdatedReferenceProblem<Stored, Factor>::changeOfSystem(const MatrixXd& v,
                                                                 const Job& job) const {
  const BoundaryField after = dofs().expand(v, MatrixXd());
  BoundaryField difference = base_->dofs().expand(v, MatrixXd());
  difference.u = after.u - difference.u;
  difference.p = after.p - difference.p;
  // Usually zero; frames and projections change only where rollers guide moved faces.
  MatrixXd r = difference.u.isZero(0) && difference.p.isZero(0)
                   ? MatrixXd(MatrixXd::Zero(dofs().count(), v.cols()))
                   : base_->residual(difference, job);
  change_.addTo(after, r, job);
  return -r;
}

template <class Stored, class Factor>
MatrixXd UpdatedReferenceProblem<Stored, Factor>::correction(const MatrixXd& r,
                                                             const Job& job) const {
  constexpr double kTolerance = 1e-7;
  constexpr int kMaxSteps = 60;
  const auto apply = [&](const MatrixXd& v) -> MatrixXd {
    return v + base_->correction(changeOfSystem(v, job), job);
  };
  return gmres(apply, base_->correction(r, job), kTolerance, kMaxSteps, job).x;
}

template <class Stored, class Factor>
void UpdatedReferenceProblem<Stored, Factor>::write(const ByteSink&) const {
  throw std::logic_error("UpdatedReferenceProblem: only a full rebuild can be stored");
}

template struct OperatorChange<double>;
template struct OperatorChange<float>;
template class UpdatedReferenceProblem<double, double>;
template class UpdatedReferenceProblem<double, float>;
template class UpdatedReferenceProblem<float, float>;

}  // namespace palpa::bem
