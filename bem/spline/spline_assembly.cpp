#include "bem/spline/spline_assembly.h"

#include <algorithm>
#include <array>

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

/// Copies the blocks that the sums of a task's points make to their rows of a matrix.
template <int kSums, class Scalar, class Block>
void copyRows(const std::array<std::vector<double>, kPointsPerTask>& sums, std::ptrdiff_t begin,
              std::ptrdiff_t end, std::ptrdiff_t pointCount, const Block& block,
              LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t coefficients = matrix.cols() / 3, rows = matrix.rows();
  const bool isFull = end - begin == kPointsPerTask;
  double transposed[kSums][kPointsPerTask] = {};
  Scalar values[kPointsPerTask];
  for (std::ptrdiff_t j = 0; j < coefficients; ++j) {
    for (std::ptrdiff_t k = 0; k < end - begin; ++k)
      for (int s = 0; s < kSums; ++s) transposed[s][k] = sums[k][kSums * j + s];
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < kPointsPerTask; ++k)
          values[k] = static_cast<Scalar>(block(&transposed[0][k], i, c));
        Scalar* to = matrix.data() + (3 * j + c) * rows + i * pointCount + begin;
        // A length known beforehand is copied without a call.
        if (isFull)
          std::copy_n(values, kPointsPerTask, to);
        else
          std::copy_n(values, end - begin, to);
      }
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
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      rows.integrate(points[k], scratch.sums, job);
      scratch.sums.T.swap(scratch.T[k - begin]);
      scratch.sums.U.swap(scratch.U[k - begin]);
    }
    copyRows<SplineRows::kSumsT>(
        scratch.T, begin, end, m,
        [&](const double* sum, int i, int c) { return rows.blockT(sum, i, c, kPointsPerTask); },
        result.H);
    copyRows<SplineRows::kSumsU>(
        scratch.U, begin, end, m,
        [&](const double* sum, int i, int c) { return rows.blockU(sum, i, c, kPointsPerTask); },
        result.G);
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
