#include <algorithm>
#include <chrono>
#include <span>

#include "bem/assembly_kernel.h"
#include "bem/lu_factorisation.h"
#include "bem/parallel.h"
#include "bem/reference_problem.h"
#include "bem/spline/spline_assembly.h"

namespace palpa::bem {
namespace {

using Eigen::MatrixXd;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<int> nonzeroRows(const MatrixXd& x) {
  std::vector<int> rows;
  for (Eigen::Index row = 0; row < x.rows(); ++row)
    if (!x.row(row).isZero(0)) rows.push_back(static_cast<int>(row));
  return rows;
}

/// y += matrix * x in double precision, on all cores, touching only columns whose factors are not
/// zero.
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
  parallelFor((matrix.rows() + kRowsPerTask - 1) / kRowsPerTask, job, "", [&](std::ptrdiff_t k) {
    ProductTask<Scalar> part = task;
    part.rowBegin = k * kRowsPerTask;
    part.rowEnd = std::min(part.rows, part.rowBegin + kRowsPerTask);
    product(part);
  });
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
  parallelFor((dofs.count() + kColumnsPerTask - 1) / kColumnsPerTask, job, "",
              [&](std::ptrdiff_t k) {
                const auto end = std::min<std::ptrdiff_t>(dofs.count(), (k + 1) * kColumnsPerTask);
                for (auto dof = static_cast<int>(k * kColumnsPerTask); dof < end; ++dof) {
                  auto column = A.view().col(dof);
                  const auto addColumn = [&](const auto& source, double factor) {
                    if (factor != 0)
                      column += static_cast<Factor>(factor) * source.template cast<Factor>();
                  };
                  if (dof < dofs.nodalCount() && !dofs.isConstrained(dof)) {
                    const int node = dof / 3;
                    for (int i = 0; i < 3; ++i)
                      addColumn(H.col(3 * node + i), dofs.frame(node)(i, dof % 3));
                  } else {
                    for (const auto& weight : dofs.tractionOf(dof))
                      for (int i = 0; i < 3; ++i)
                        addColumn(G.col(3 * weight.slot + i), -weight.traction[i]);
                  }
                }
              });
  return A;
}

template <class Stored, class Factor>
class DenseReferenceProblem final : public ReferenceProblem {
 public:
  DenseReferenceProblem(DegreesOfFreedom dofMap, BoundaryOperators<Stored> operators,
                        const Job& job)
      : ReferenceProblem(std::move(dofMap)),
        operators_(std::move(operators)),
        factors_(systemMatrix<Stored, Factor>(operators_, dofs(), job), job) {}

  /// What write() wrote.
  DenseReferenceProblem(DegreesOfFreedom dofMap, const ByteSource& source)
      : ReferenceProblem(std::move(dofMap)),
        operators_(readOperators(dofs(), source)),
        factors_(dofs().count(), source) {}

  void write(const ByteSink& sink) const override {
    const auto writeMatrix = [&](const LargeMatrix<Stored>& matrix) {
      sink(std::as_bytes(std::span(matrix.data(), matrix.bytes() / sizeof(Stored))));
    };
    writeMatrix(operators_.H);
    writeMatrix(operators_.G);
    factors_.write(sink);
  }

  MatrixXd solve(const BoundaryField& known, Effort effort, const Job& job) const override {
    constexpr bool kExactFactors = std::is_same_v<Factor, double>;
    constexpr double kConverged = std::is_same_v<Stored, double> ? 1e-13 : 1e-9;
    const int rounds = effort == Effort::kFast ? 1 : kExactFactors ? 2 : 8;
    MatrixXd v = MatrixXd::Zero(dofs().count(), known.u.cols());
    BoundaryField field = known;
    double previous = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
      const MatrixXd step = correction(residual(field, job), job);
      const double change = step.norm();
      if (!(change < 0.5 * previous)) break;  // refinement has reached the rounding of the residual
      v += step;
      previous = change;
      if (change <= kConverged * v.norm() || round + 1 == rounds) break;
      field = dofs().expand(v, MatrixXd());
      field.u += known.u;
      field.p += known.p;
    }
    return v;
  }

  MatrixXd correction(const MatrixXd& r) const override { return correction(r, Job{}); }

  double relativeResidual(const BoundaryField& field) const override {
    MatrixXd fromTraction = MatrixXd::Zero(operators_.G.rows(), field.p.cols());
    addProduct(operators_.G, field.p, fromTraction, Job{});
    const double size = fromTraction.template lpNorm<Eigen::Infinity>();
    const double defect = residual(field, Job{}).template lpNorm<Eigen::Infinity>();
    return defect / std::max(size, 1e-300);
  }

  double conditionEstimate(const Job& job) const override {
    return factors_.conditionEstimate(job);
  }

  std::size_t bytes() const override {
    return operators_.H.bytes() + operators_.G.bytes() + factors_.bytes();
  }

 private:
  MatrixXd correction(const MatrixXd& r, const Job& job) const {
    // Each column is scaled to 1 so that single precision neither overflows nor loses small states.
    const Eigen::RowVectorXd scale =
        r.colwise().template lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
    Eigen::Matrix<Factor, Eigen::Dynamic, Eigen::Dynamic> step =
        (r * scale.cwiseInverse().asDiagonal()).template cast<Factor>();
    factors_.solveInPlace(step, job);
    return step.template cast<double>() * scale.asDiagonal();
  }

  static BoundaryOperators<Stored> readOperators(const DegreesOfFreedom& dofs,
                                                 const ByteSource& source) {
    BoundaryOperators<Stored> operators{{dofs.count(), dofs.nodalCount()},
                                        {dofs.count(), 3 * dofs.slotCount()}};
    for (auto* matrix : {&operators.H, &operators.G})
      source(std::as_writable_bytes(std::span(matrix->data(), matrix->bytes() / sizeof(Stored))));
    return operators;
  }

  MatrixXd residual(const BoundaryField& field, const Job& job) const {
    MatrixXd r = MatrixXd::Zero(operators_.H.rows(), field.u.cols());
    addProduct<Stored>(operators_.H, -field.u, r, job);
    addProduct<Stored>(operators_.G, field.p, r, job);
    return r;
  }

  BoundaryOperators<Stored> operators_;
  LuFactorisation<Factor> factors_;
};

/// Calls make(Stored{}, Factor{}) for the scalars of a precision.
template <class Make>
std::unique_ptr<ReferenceProblem> inPrecision(Precision precision, const DegreesOfFreedom& dofs,
                                              const Make& make) {
  switch (choosePrecision(precision, dofs.nodeCount())) {
    case Precision::kMixed:
      return make(double{}, float{});
    case Precision::kSingle:
      return make(float{}, float{});
    default:
      return make(double{}, double{});
  }
}

/// `assembleOperators(Scalar{})` yields the operators in the precision of a Scalar.
template <class Assemble>
std::unique_ptr<ReferenceProblem> make(Precision precision, DegreesOfFreedom dofs,
                                       const Assemble& assembleOperators, const Job& job,
                                       ReferenceProblemTimes* times) {
  return inPrecision(precision, dofs, [&](auto stored, auto factor) {
    const auto start = std::chrono::steady_clock::now();
    auto operators = assembleOperators(stored);
    if (times) times->assemble = secondsSince(start);
    const auto assembled = std::chrono::steady_clock::now();
    auto problem = std::make_unique<DenseReferenceProblem<decltype(stored), decltype(factor)>>(
        std::move(dofs), std::move(operators), job);
    if (times) times->factorise = secondsSince(assembled);
    return problem;
  });
}

std::unique_ptr<ReferenceProblem> read(Precision precision, DegreesOfFreedom dofs,
                                       const ByteSource& source) {
  return inPrecision(precision, dofs, [&](auto stored, auto factor) {
    return std::make_unique<DenseReferenceProblem<decltype(stored), decltype(factor)>>(
        std::move(dofs), source);
  });
}

DegreesOfFreedom solvableDofs(const BoundaryMesh& mesh, const TractionSlots& slots,
                              const std::vector<SlotCondition>& conditions,
                              const Material& material) {
  material.validate();
  DegreesOfFreedom dofs(mesh, slots, conditions, material);
  checkSolvable(mesh, conditions, dofs, material);
  return dofs;
}

DegreesOfFreedom solvableDofs(const SplineSurface& surface, const SplineTractions& tractions,
                              const std::vector<SlotCondition>& conditions,
                              const Material& material) {
  material.validate();
  const double size = surface.boundingSize();
  DegreesOfFreedom dofs(tractions.slots, conditions, material, size);
  checkSolvable(surface.controlPoints(), size, surface.closedSurfaceCount(), conditions, dofs,
                material);
  return dofs;
}

}  // namespace

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(mesh, slots, conditions, material);
  const auto points = dofs.collocationPoints(mesh, slots);
  return make(
      precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(mesh, slots, points, material, options, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(surface, tractions, conditions, material);
  const SplineEquations equations = splineEquations(surface, tractions, dofs.extraSlots());
  return make(
      precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(surface, tractions, equations, material, options, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source) {
  return read(precision, solvableDofs(mesh, slots, conditions, material), source);
}

std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source) {
  return read(precision, solvableDofs(surface, tractions, conditions, material), source);
}

}  // namespace palpa::bem
