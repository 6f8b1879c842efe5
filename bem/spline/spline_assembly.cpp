#include "bem/spline/spline_assembly.h"

#include <algorithm>

#include "bem/lending_pool.h"
#include "bem/parallel.h"
#include "bem/spline/spline_rows.h"

namespace palpa::bem {
namespace {

constexpr std::ptrdiff_t kPointsPerTask = 16;

/// What a thread needs; used again from task to task.
struct Scratch {
  SplineRows::Sums sums;
  std::vector<double> rowsH, rowsG;  ///< blocks of a task, [coefficient][3 x 3][point]
};

/// Copies the blocks of one point into those of a task.
void storeBlocks(const SplineRows& rows, std::ptrdiff_t place, Scratch& scratch) {
  const auto store = [place](const std::vector<double>& sums, int size, std::vector<double>& to,
                             const auto& block) {
    double* out = to.data() + place;
    for (std::size_t k = 0; k < sums.size(); k += size, out += 9 * kPointsPerTask)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) out[(3 * i + c) * kPointsPerTask] = block(&sums[k], i, c);
  };
  store(scratch.sums.T, SplineRows::kSumsT, scratch.rowsH,
        [&](const double* sum, int i, int c) { return rows.blockT(sum, i, c); });
  store(scratch.sums.U, SplineRows::kSumsU, scratch.rowsG,
        [&](const double* sum, int i, int c) { return rows.blockU(sum, i, c); });
}

/// Copies the blocks of a task to its rows of a matrix.
template <class Scalar>
void copyRows(const std::vector<double>& rows, std::ptrdiff_t begin, std::ptrdiff_t end,
              std::ptrdiff_t pointCount, LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t coefficients = matrix.cols() / 3;
  for (std::ptrdiff_t j = 0; j < coefficients; ++j)
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) {
        const double* from = rows.data() + (9 * j + 3 * i + c) * kPointsPerTask;
        Scalar* to = matrix.data() + (3 * j + c) * matrix.rows() + i * pointCount + begin;
        for (std::ptrdiff_t k = 0; k < end - begin; ++k) to[k] = static_cast<Scalar>(from[k]);
      }
}

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const std::vector<SplineCollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job) {
  material.validate();
  const auto m = static_cast<std::ptrdiff_t>(points.size());
  BoundaryOperators<Scalar> result{
      LargeMatrix<Scalar>(3 * m, 3 * static_cast<Eigen::Index>(surface.coefficientCount())),
      LargeMatrix<Scalar>(3 * m, 3 * static_cast<Eigen::Index>(tractions.slots.count()))};
  const SplineQuadrature quadrature(surface, options.tolerance, job);
  const SplineRows rows(surface, tractions, material, quadrature);
  LendingPool<Scratch> pool([] { return Scratch{}; });
  parallelFor((m + kPointsPerTask - 1) / kPointsPerTask, job, "assemble", [&](std::ptrdiff_t task) {
    const std::ptrdiff_t begin = task * kPointsPerTask, end = std::min(m, begin + kPointsPerTask);
    Scratch scratch = pool.take();
    scratch.rowsH.resize(static_cast<std::size_t>(9 * kPointsPerTask) * surface.coefficientCount());
    scratch.rowsG.resize(static_cast<std::size_t>(9 * kPointsPerTask) * tractions.slots.count());
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      rows.integrate(points[k], scratch.sums, job);
      storeBlocks(rows, k - begin, scratch);
    }
    copyRows(scratch.rowsH, begin, end, m, result.H);
    copyRows(scratch.rowsG, begin, end, m, result.G);
    pool.giveBack(std::move(scratch));
  });
  return result;
}

template BoundaryOperators<double> assemble(const SplineSurface&, const SplineTractions&,
                                            const std::vector<SplineCollocationPoint>&,
                                            const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const SplineSurface&, const SplineTractions&,
                                           const std::vector<SplineCollocationPoint>&,
                                           const Material&, const AssemblyOptions&, const Job&);

}  // namespace palpa::bem
