#include "bem/spline/spline_assembly.h"

#include <algorithm>
#include <array>

#include "bem/lending_pool.h"
#include "bem/parallel.h"
#include "bem/spline/spline_rows.h"

namespace palpa::bem {
namespace {

constexpr int kMostPointsPerTask = 16;
/// Few points are shared out more evenly in smaller tasks.
std::ptrdiff_t pointsPerTask(std::ptrdiff_t points) {
  return points < 512 ? 8 : kMostPointsPerTask;
}

/// What a thread needs; used again from task to task.
struct Scratch {
  SplineRows::Sums sums;                                     ///< of one point
  std::array<std::vector<double>, kMostPointsPerTask> T, U;  ///< of the points of a task
};

/// Copies the blocks that some points' sums make to their rows of a matrix.
template <int kSums, class Scalar, class Block>
void copyRows(const std::array<std::vector<double>, kMostPointsPerTask>& sums, std::ptrdiff_t begin,
              std::ptrdiff_t end, std::ptrdiff_t pointCount, const Block& block,
              LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t coefficients = matrix.cols() / 3, rows = matrix.rows();
  Scalar blocks[3][3][kMostPointsPerTask];
  for (std::ptrdiff_t j = 0; j < coefficients; ++j) {
    for (std::ptrdiff_t k = 0; k < end - begin; ++k) {
      const double* sum = &sums[k][kSums * j];
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) blocks[i][c][k] = static_cast<Scalar>(block(sum, i, c));
    }
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        std::copy_n(blocks[i][c], end - begin,
                    matrix.data() + (3 * j + c) * rows + i * pointCount + begin);
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
  const std::ptrdiff_t perTask = pointsPerTask(m);
  parallelFor((m + perTask - 1) / perTask, job, "assemble", [&](std::ptrdiff_t task) {
    const std::ptrdiff_t begin = task * perTask, end = std::min(m, begin + perTask);
    Scratch scratch = pool.take();
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      rows.integrate(points[k], scratch.sums, job);
      scratch.sums.T.swap(scratch.T[k - begin]);
      scratch.sums.U.swap(scratch.U[k - begin]);
    }
    copyRows<SplineRows::kSumsT>(
        scratch.T, begin, end, m,
        [&](const double* sum, int i, int c) { return rows.blockT(sum, i, c); }, result.H);
    copyRows<SplineRows::kSumsU>(
        scratch.U, begin, end, m,
        [&](const double* sum, int i, int c) { return rows.blockU(sum, i, c); }, result.G);
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
