#include "bem/spline/spline_assembly.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "bem/lending_pool.h"
#include "bem/parallel.h"
#include "bem/spline/spline_rows.h"

namespace palpa::bem {
namespace {

constexpr int kPointsPerTask = 8;

/// What a thread needs; used again from task to task.
struct Scratch {
  SplineRows::Sums sums;                                 ///< of one point
  std::array<std::vector<double>, kPointsPerTask> T, U;  ///< of the points of a task
};

/// Copies the blocks that the sums of a task's points make to their rows of a matrix, which has
/// columns for some of the coefficients.
template <int kSums, class Scalar, class Block>
void copyRows(const std::array<std::vector<double>, kPointsPerTask>& sums, std::ptrdiff_t begin,
              std::ptrdiff_t end, std::ptrdiff_t pointCount, std::span<const int> coefficients,
              const Block& block, LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t rows = matrix.rows();
  const bool isFull = end - begin == kPointsPerTask;
  double transposed[kSums][kPointsPerTask] = {};
  Scalar values[kPointsPerTask];
  for (std::size_t j = 0; j < coefficients.size(); ++j) {
    const auto first = static_cast<std::size_t>(kSums) * coefficients[j];
    for (std::ptrdiff_t k = 0; k < end - begin; ++k)
      for (int s = 0; s < kSums; ++s) transposed[s][k] = sums[k][first + s];
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < kPointsPerTask; ++k)
          values[k] = static_cast<Scalar>(block(&transposed[0][k], i, c));
        Scalar* to =
            matrix.data() + static_cast<std::ptrdiff_t>(3 * j + c) * rows + i * pointCount + begin;
        // A length known beforehand is copied without a call.
        if (isFull)
          std::copy_n(values, kPointsPerTask, to);
        else
          std::copy_n(values, end - begin, to);
      }
  }
}

/// What the sums of points are taken over, and the columns that they go to.
struct Columns {
  std::optional<std::span<const int>> elements;  ///< none: all
  std::span<const int> coefficients, slots;
};

/// Rows of points, [i * count + point].
template <class Scalar>
BoundaryOperators<Scalar> rowsOf(const SplineRows& rows, const Columns& columns,
                                 std::span<const SplineCollocationPoint> points,
                                 std::string_view phase, const Job& job) {
  const auto m = static_cast<std::ptrdiff_t>(points.size());
  const auto triple = [](std::span<const int> some) {
    return 3 * static_cast<Eigen::Index>(some.size());
  };
  BoundaryOperators<Scalar> result{LargeMatrix<Scalar>(3 * m, triple(columns.coefficients)),
                                   LargeMatrix<Scalar>(3 * m, triple(columns.slots))};
  LendingPool<Scratch> pool([] { return Scratch{}; });
  parallelFor((m + kPointsPerTask - 1) / kPointsPerTask, job, phase, [&](std::ptrdiff_t task) {
    const std::ptrdiff_t begin = task * kPointsPerTask, end = std::min(m, begin + kPointsPerTask);
    Scratch scratch = pool.take();
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      if (columns.elements)
        rows.integrateOver(*columns.elements, points[k], scratch.sums, job);
      else
        rows.integrate(points[k], scratch.sums, job);
      scratch.sums.T.swap(scratch.T[k - begin]);
      scratch.sums.U.swap(scratch.U[k - begin]);
    }
    copyRows<SplineRows::kSumsT>(
        scratch.T, begin, end, m, columns.coefficients,
        [&](const double* sum, int i, int c) { return rows.blockT(sum, i, c, kPointsPerTask); },
        result.H);
    copyRows<SplineRows::kSumsU>(
        scratch.U, begin, end, m, columns.slots,
        [&](const double* sum, int i, int c) { return rows.blockU(sum, i, c, kPointsPerTask); },
        result.G);
    pool.giveBack(std::move(scratch));
  });
  return result;
}

/// Points whose rows are held at once before they are added to those of equations.
constexpr std::size_t kPointsAtOnce = 128;
constexpr Eigen::Index kColumnsPerTask = 64;

/// Adds the rows of the points from `first` on, times their weights, to those of the equations.
template <class Scalar>
void addWeighted(const LargeMatrix<Scalar>& ofPoints, const Eigen::SparseMatrix<double>& weights,
                 Eigen::Index first, LargeMatrix<Scalar>& ofEquations, const Job& job) {
  const Eigen::Index count = ofPoints.rows() / 3, columns = ofPoints.cols();
  const auto from = ofPoints.view();
  auto to = ofEquations.view();
  const auto tasks = static_cast<std::ptrdiff_t>((columns + kColumnsPerTask - 1) / kColumnsPerTask);
  parallelFor(tasks, job, "", [&](std::ptrdiff_t task) {
    const Eigen::Index end = std::min<Eigen::Index>(columns, (task + 1) * kColumnsPerTask);
    for (Eigen::Index column = task * kColumnsPerTask; column < end; ++column)
      for (int i = 0; i < 3; ++i)
        for (Eigen::Index k = 0; k < count; ++k)
          for (Eigen::SparseMatrix<double>::InnerIterator w(weights, first + k); w; ++w)
            to(i * weights.rows() + w.row(), column) +=
                static_cast<Scalar>(w.value()) * from(i * count + k, column);
  });
}

/// Rows of equations: weighted sums of those of their points.
template <class Scalar>
BoundaryOperators<Scalar> rowsOf(const SplineRows& rows, const Columns& columns,
                                 const SplineEquations& equations, std::string_view phase,
                                 const Job& job) {
  const std::span points(equations.points);
  if (equations.isCollocation()) return rowsOf<Scalar>(rows, columns, points, phase, job);
  const Eigen::Index count = 3 * equations.weights.rows();
  BoundaryOperators<Scalar> result{
      LargeMatrix<Scalar>(count, 3 * static_cast<Eigen::Index>(columns.coefficients.size())),
      LargeMatrix<Scalar>(count, 3 * static_cast<Eigen::Index>(columns.slots.size()))};
  const auto all = static_cast<double>(points.size());
  for (std::size_t first = 0; first < points.size(); first += kPointsAtOnce) {
    const auto some = points.subspan(first, std::min(kPointsAtOnce, points.size() - first));
    Job ofSome = job;
    if (job.progress)
      ofSome.progress = [&](std::string_view name, double fraction) {
        job.progress(
            name, (static_cast<double>(first) + fraction * static_cast<double>(some.size())) / all);
      };
    const auto ofPoints = rowsOf<Scalar>(rows, columns, some, phase, ofSome);
    addWeighted(ofPoints.H, equations.weights, static_cast<Eigen::Index>(first), result.H, job);
    addWeighted(ofPoints.G, equations.weights, static_cast<Eigen::Index>(first), result.G, job);
  }
  return result;
}

/// `points`: collocation points or equations.
template <class Scalar, class Points>
BoundaryOperators<Scalar> allRows(const SplineSurface& surface, const SplineTractions& tractions,
                                  const Points& points, const Material& material,
                                  const AssemblyOptions& options, const Job& job) {
  material.validate();
  const SplineQuadrature quadrature(surface, options.tolerance, job);
  const SplineRows rows(surface, tractions, material, quadrature);
  std::vector<int> coefficients(surface.coefficientCount()), slots(tractions.slots.count());
  std::iota(coefficients.begin(), coefficients.end(), 0);
  std::iota(slots.begin(), slots.end(), 0);
  return rowsOf<Scalar>(rows, {std::nullopt, coefficients, slots}, points, "assemble", job);
}

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const std::vector<SplineCollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job) {
  return allRows<Scalar>(surface, tractions, std::span(points), material, options, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const SplineEquations& equations, const Material& material,
                                   const AssemblyOptions& options, const Job& job) {
  return allRows<Scalar>(surface, tractions, equations, material, options, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const SplineSurface& surface,
                                       const SplineTractions& tractions, const ElementPart& part,
                                       const SplineEquations& equations, const Material& material,
                                       const AssemblyOptions& options, const Job& job) {
  material.validate();
  const SplineQuadrature quadrature(surface, options.tolerance, job);
  const SplineRows rows(surface, tractions, material, quadrature);
  return rowsOf<Scalar>(rows, {part.elements, part.coefficients, part.slots}, equations, "", job);
}

template BoundaryOperators<double> assemble(const SplineSurface&, const SplineTractions&,
                                            const std::vector<SplineCollocationPoint>&,
                                            const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const SplineSurface&, const SplineTractions&,
                                           const std::vector<SplineCollocationPoint>&,
                                           const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<double> assemble(const SplineSurface&, const SplineTractions&,
                                            const SplineEquations&, const Material&,
                                            const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const SplineSurface&, const SplineTractions&,
                                           const SplineEquations&, const Material&,
                                           const AssemblyOptions&, const Job&);

template BoundaryOperators<double> assemblePart(const SplineSurface&, const SplineTractions&,
                                                const ElementPart&, const SplineEquations&,
                                                const Material&, const AssemblyOptions&,
                                                const Job&);
template BoundaryOperators<float> assemblePart(const SplineSurface&, const SplineTractions&,
                                               const ElementPart&, const SplineEquations&,
                                               const Material&, const AssemblyOptions&, const Job&);

}  // namespace palpa::bem
