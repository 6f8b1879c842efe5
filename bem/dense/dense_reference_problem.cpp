#include "bem/dense/dense_reference_problem.h"

#include <algorithm>

#include "base/parallel.h"
#include "bem/triangle/assembly_kernel.h"

namespace palpa::bem {
namespace {

using Eigen::MatrixXd;

std::vector<int> nonzeroRows(const MatrixXd& x) {
  std::vector<int> rows;
  for (Eigen::Index row = 0; row < x.rows(); ++row)
    if (!x.row(row).isZero(0)) rows.push_back(static_cast<int>(row));
  return rows;
}

/// Column of A0 for every degree of freedom: displacement columns of H where the displacement is
/// unknown, minus traction columns of G where the traction is.
template <class Stored, class Factor>
LargeMatrix<Factor> systemMatrix(const BoundaryOperators<Stored>& operators,
                                 const DegreesOfFreedom& dofs, const Job& job) {
  LargeMatrix<Factor> A(operators.H.rows(), dofs.count());
  const auto H = operators.H.view();
  const auto G = operators.G.view();
  constexpr std::ptrdiff_t kColumnsPerTask = 64;
  parallelFor((dofs.count() + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t k) {
    const auto end = std::min<std::ptrdiff_t>(dofs.count(), (k + 1) * kColumnsPerTask);
    for (auto dof = static_cast<int>(k * kColumnsPerTask); dof < end; ++dof) {
      auto column = A.view().col(dof);
      const auto addColumn = [&](const auto& source, double factor) {
        if (factor != 0) column += static_cast<Factor>(factor) * source.template cast<Factor>();
      };
      if (dof < dofs.nodalCount() && !dofs.isConstrained(dof)) {
        const int node = dof / 3;
        for (int i = 0; i < 3; ++i) addColumn(H.col(3 * node + i), dofs.frame(node)(i, dof % 3));
      } else {
        for (const auto& weight : dofs.tractionOf(dof))
          for (int i = 0; i < 3; ++i) addColumn(G.col(3 * weight.slot + i), -weight.traction[i]);
      }
    }
  });
  return A;
}

template <class Scalar>
BoundaryOperators<Scalar> readOperators(const DegreesOfFreedom& dofs, const ByteSource& source) {
  BoundaryOperators<Scalar> operators{{dofs.count(), dofs.nodalCount()},
                                      {dofs.count(), 3 * dofs.slotCount()}};
  for (auto* matrix : {&operators.H, &operators.G})
    source(std::as_writable_bytes(std::span(matrix->data(), matrix->bytes() / sizeof(Scalar))));
  return operators;
}

}  // namespace

template <class Scalar>
void addProduct(const LargeMatrix<Scalar>& matrix, const MatrixXd& x, MatrixXd& y, const Job& job) {
  constexpr std::ptrdiff_t kRowsPerTask = 1024;
  const std::vector<int> columns = nonzeroRows(x);
  ProductTask<Scalar> task{matrix.data(),
                           matrix.rows(),
                           0,
                           0,
                           columns.data(),
                           static_cast<std::ptrdiff_t>(columns.size()),
                           x.data(),
                           x.rows(),
                           static_cast<int>(x.cols()),
                           y.data()};
  const AddProduct<Scalar> product = addProductForThisProcessor<Scalar>();
  parallelFor((matrix.rows() + kRowsPerTask - 1) / kRowsPerTask, job, [&](std::ptrdiff_t k) {
    ProductTask<Scalar> part = task;
    part.rowBegin = k * kRowsPerTask;
    part.rowEnd = std::min(part.rows, part.rowBegin + kRowsPerTask);
    product(part);
  });
}

template <class Stored, class Factor>
DenseReferenceProblem<Stored, Factor>::DenseReferenceProblem(DegreesOfFreedom dofMap,
                                                             BoundaryOperators<Stored> operators,
                                                             const Job& job)
    : ReferenceProblem(std::move(dofMap), kRefinement),
      operators_(std::move(operators)),
      factors_(systemMatrix<Stored, Factor>(operators_, dofs(), job), job) {}

template <class Stored, class Factor>
DenseReferenceProblem<Stored, Factor>::DenseReferenceProblem(DegreesOfFreedom dofMap,
                                                             const ByteSource& source)
    : ReferenceProblem(std::move(dofMap), kRefinement),
      operators_(readOperators<Stored>(dofs(), source)),
      factors_(dofs().count(), source) {}

template <class Stored, class Factor>
void DenseReferenceProblem<Stored, Factor>::write(const ByteSink& sink) const {
  const auto writeMatrix = [&](const LargeMatrix<Stored>& matrix) {
    sink(std::as_bytes(std::span(matrix.data(), matrix.bytes() / sizeof(Stored))));
  };
  writeMatrix(operators_.H);
  writeMatrix(operators_.G);
  factors_.write(sink);
}

template <class Stored, class Factor>
MatrixXd DenseReferenceProblem<Stored, Factor>::residual(const BoundaryField& field,
                                                         const Job& job) const {
  MatrixXd r = MatrixXd::Zero(operators_.H.rows(), field.u.cols());
  addProduct<Stored>(operators_.H, -field.u, r, job);
  addProduct<Stored>(operators_.G, field.p, r, job);
  return r;
}

template <class Stored, class Factor>
MatrixXd DenseReferenceProblem<Stored, Factor>::correction(const MatrixXd& r,
                                                           const Job& job) const {
  // Each column is scaled to 1, so that single precision neither overflows nor loses small states.
  const Eigen::RowVectorXd scale = r.colwise().template lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  Eigen::Matrix<Factor, Eigen::Dynamic, Eigen::Dynamic> step =
      (r * scale.cwiseInverse().asDiagonal()).template cast<Factor>();
  factors_.solveInPlace(step, job);
  return step.template cast<double>() * scale.asDiagonal();
}

template <class Stored, class Factor>
MatrixXd DenseReferenceProblem<Stored, Factor>::transposedCorrection(const MatrixXd& r) const {
  const Eigen::RowVectorXd scale = r.colwise().template lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  Eigen::Matrix<Factor, Eigen::Dynamic, Eigen::Dynamic> step =
      (r * scale.cwiseInverse().asDiagonal()).template cast<Factor>();
  factors_.solveTransposedInPlace(step);
  return step.template cast<double>() * scale.asDiagonal();
}

template void addProduct(const LargeMatrix<double>&, const MatrixXd&, MatrixXd&, const Job&);
template void addProduct(const LargeMatrix<float>&, const MatrixXd&, MatrixXd&, const Job&);
template class DenseReferenceProblem<double, double>;
template class DenseReferenceProblem<double, float>;
template class DenseReferenceProblem<float, float>;

}  // namespace palpa::bem
