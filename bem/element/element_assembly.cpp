#include "bem/element/element_assembly.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"
#include "bem/element/averaged_rows.h"
#include "bem/element/element_rows.h"
#include "bem/element/equation_sums.h"

namespace palpa::bem {
namespace {

constexpr int kPointsPerTask = kElementLanes;

/// Memory of one thread, reused from task to task.
struct Scratch {
  ElementRows::Sums sums;                                ///< of one point
  std::array<std::vector<double>, kPointsPerTask> T, U;  ///< of the points of a task
};

/// Number of coefficients whose blocks are computed together, so that they stay in the nearest
/// cache.
constexpr std::size_t kCoefficientsAtOnce = 32;

/// Computes the blocks of a task's points from their sums and copies them to their rows of a
/// matrix, which has columns for the given coefficients.
template <class Scalar>
void copyRows(void (*makeBlocks)(const MakeBlocksTask&), const KelvinConstants& constants,
              const std::array<std::vector<double>, kPointsPerTask>& sums, std::ptrdiff_t begin,
              std::ptrdiff_t end, std::ptrdiff_t pointCount, std::span<const int> coefficients,
              LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t rows = matrix.rows();
  const bool isFull = end - begin == kPointsPerTask;
  alignas(64) double blocks[kCoefficientsAtOnce][9][kPointsPerTask];
  MakeBlocksTask task{constants, {}, nullptr, 0, &blocks[0][0][0]};
  for (int k = 0; k < kPointsPerTask; ++k) task.sums[k] = sums[begin + k < end ? k : 0].data();
  for (std::size_t first = 0; first < coefficients.size(); first += kCoefficientsAtOnce) {
    const std::size_t count = std::min(kCoefficientsAtOnce, coefficients.size() - first);
    task.coefficients = coefficients.data() + first;
    task.count = static_cast<int>(count);
    makeBlocks(task);
    for (std::size_t j = 0; j < count; ++j)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i) {
          const double* from = blocks[j][3 * c + i];
          Scalar* to = matrix.data() + static_cast<std::ptrdiff_t>(3 * (first + j) + c) * rows +
                       i * pointCount + begin;
          // A length known at compile time is copied without a function call.
          const auto cast = [](double value) { return static_cast<Scalar>(value); };
          if (isFull)
            std::transform(from, from + kPointsPerTask, to, cast);
          else
            std::transform(from, from + (end - begin), to, cast);
        }
  }
}

/// Elements over which the sums of points are taken, and the columns of the result.
struct Columns {
  std::optional<std::span<const int>> elements;  ///< none: all
  std::span<const int> coefficients, slots;
};

/// Zero operators with three rows per point (or equation).
template <class Scalar>
BoundaryOperators<Scalar> operatorsFor(std::size_t points, const Columns& columns) {
  const auto triple = [](std::size_t some) { return 3 * static_cast<Eigen::Index>(some); };
  return {LargeMatrix<Scalar>(triple(points), triple(columns.coefficients.size())),
          LargeMatrix<Scalar>(triple(points), triple(columns.slots.size()))};
}

/// Computes the first 3 `count` rows of `result`, the rows of points, ordered as [i * count +
/// point]. `integrate`(index, sums): computes the sums of a point.
template <class Scalar, class Integrate>
void computeRows(const KelvinConstants& constants, const Columns& columns, std::size_t count,
                 std::optional<Phase> phase, const Job& job, const Integrate& integrate,
                 BoundaryOperators<Scalar>& result) {
  const auto m = static_cast<std::ptrdiff_t>(count);
  const KelvinSumLoops loops = kelvinSumLoopsForThisProcessor();
  ScratchPool<Scratch> pool([] { return Scratch{}; });
  parallelFor((m + kPointsPerTask - 1) / kPointsPerTask, job, phase, [&](std::ptrdiff_t task) {
    const std::ptrdiff_t begin = task * kPointsPerTask, end = std::min(m, begin + kPointsPerTask);
    Scratch scratch = pool.take();
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      integrate(static_cast<std::size_t>(k), scratch.sums);
      scratch.sums.T.swap(scratch.T[k - begin]);
      scratch.sums.U.swap(scratch.U[k - begin]);
    }
    copyRows(loops.makeBlocksT, constants, scratch.T, begin, end, m, columns.coefficients,
             result.H);
    copyRows(loops.makeBlocksU, constants, scratch.U, begin, end, m, columns.slots, result.G);
    pool.giveBack(std::move(scratch));
  });
}

/// Number of points whose rows are stored at once before they are added to the rows of equations:
/// about 100 MiB, because each batch reads and writes most of the rows of the equations; for many
/// columns at least enough to keep all threads busy. No columns (an empty part) is a valid number.
std::size_t pointsAtOnce(Eigen::Index columns) {
  constexpr Eigen::Index kNumbers = 24'000'000, kMinRows = 128;
  return static_cast<std::size_t>(
      std::max(kNumbers / std::max<Eigen::Index>(3 * columns, 1), kMinRows));
}

/// Adds the rows of points to the rows of their equations.
template <class Scalar>
void addWeighted(const BoundaryOperators<Scalar>& ofPoints, const PointWeights<Scalar>& weights,
                 const Job& job, BoundaryOperators<Scalar>& ofEquations) {
  constexpr Eigen::Index kColumns = PointWeights<Scalar>::kColumns;
  const auto tasksOf = [](const LargeMatrix<Scalar>& matrix) {
    return (matrix.cols() + kColumns - 1) / kColumns;
  };
  const Eigen::Index tasksOfH = tasksOf(ofEquations.H);
  parallelFor(tasksOfH + tasksOf(ofEquations.G), job, [&](std::ptrdiff_t task) {
    if (task < tasksOfH)
      weights.add(ofPoints.H, task * kColumns, ofEquations.H);
    else
      weights.add(ofPoints.G, (task - tasksOfH) * kColumns, ofEquations.G);
  });
}

/// Adds what averaged elements have near to their equations.
template <class Scalar>
void addNear(const AveragedRows& rows, const WeightedEquations& equations, const Columns& columns,
             const std::vector<AveragedRows::Total>& totals, std::optional<Phase> phase,
             const Job& job, BoundaryOperators<Scalar>& result) {
  constexpr std::ptrdiff_t kAtOnce = 128;
  const auto count = static_cast<std::ptrdiff_t>(equations.averaged.size());
  BlockScatter<Scalar> toH(columns.coefficients, equations.weights.rows()),
      toG(columns.slots, equations.weights.rows());
  ScratchPool<AveragedRows::Scratch> pool([&] { return rows.makeScratch(); });
  std::vector<AveragedRows::Blocks> blocks(kAtOnce);
  std::vector<typename BlockScatter<Scalar>::Part> partsH, partsG;
  for (std::ptrdiff_t first = 0; first < count; first += kAtOnce) {
    const std::ptrdiff_t some = std::min(kAtOnce, count - first);
    parallelFor(some, partOfJob(job, first, first + some, count), phase, [&](std::ptrdiff_t k) {
      AveragedRows::Scratch scratch = pool.take();
      blocks[k] = rows.blocks(equations.averaged[first + k], totals, scratch);
      pool.giveBack(std::move(scratch));
    });
    partsH.clear();
    partsG.clear();
    for (std::ptrdiff_t k = 0; k < some; ++k) {
      const std::vector<int>& of = equations.averaged[first + k].equations;
      partsH.push_back({&of, &blocks[k].coefficients, &blocks[k].H});
      partsG.push_back({&of, &blocks[k].slots, &blocks[k].G});
    }
    toH.add(partsH, job, result.H);
    toG.add(partsG, job, result.G);
  }
}

/// Rows of equations: weighted sums of the rows of their points, and what averaged elements add.
template <class Scalar>
BoundaryOperators<Scalar> rowsOf(const ElementSurface& surface, const ElementQuadrature& quadrature,
                                 const Material& material, const Columns& columns,
                                 const WeightedEquations& equations, std::optional<Phase> phase,
                                 const Job& job) {
  const ElementRows rows(surface, quadrature, material);
  const AveragedRows averaged(surface, quadrature, rows.constants(), equations, columns.elements);
  std::vector<AveragedRows::Total> totals(equations.points.size());
  const auto computeRowsOfPoints = [&](std::size_t first, std::size_t count, const Job& ofSome,
                                       BoundaryOperators<Scalar>& to) {
    computeRows(
        rows.constants(), columns, count, phase, ofSome,
        [&, first](std::size_t k, ElementRows::Sums& sums) {
          const CollocationPlace& point = equations.points[first + k];
          if (const auto leftOut = averaged.leftOut(first + k); !leftOut.empty()) {
            rows.integrateOutside(leftOut, columns.elements, point, sums, job);
            std::copy(std::begin(sums.total), std::end(sums.total), totals[first + k].begin());
          } else if (columns.elements) {
            rows.integrateOver(*columns.elements, point, sums, job);
          } else {
            rows.integrate(point, sums, job);
          }
        },
        to);
  };
  const std::size_t points = equations.points.size();
  if (equations.isCollocation()) {
    auto result = operatorsFor<Scalar>(points, columns);
    computeRowsOfPoints(0, points, job, result);
    return result;
  }
  auto result = operatorsFor<Scalar>(static_cast<std::size_t>(equations.weights.rows()), columns);
  // Measured: an averaged element takes as long as two points.
  const std::size_t all = points + 2 * equations.averaged.size();
  const std::size_t atOnce = std::min(points, pointsAtOnce(result.H.cols() + result.G.cols()));
  auto ofPoints = operatorsFor<Scalar>(atOnce, columns);
  for (std::size_t first = 0; first < points; first += atOnce) {
    const std::size_t some = std::min(atOnce, points - first);
    computeRowsOfPoints(first, some, partOfJob(job, first, first + some, all), ofPoints);
    const PointWeights<Scalar> weights(equations.weights, static_cast<Eigen::Index>(first),
                                       static_cast<Eigen::Index>(some));
    addWeighted(ofPoints, weights, job, result);
  }
  addNear(averaged, equations, columns, totals, phase, partOfJob(job, points, all, all), result);
  return result;
}

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const ElementSurface& surface,
                                   const ElementQuadrature& quadrature,
                                   const WeightedEquations& equations, const Material& material,
                                   const Job& job) {
  material.validate();
  std::vector<int> coefficients(static_cast<std::size_t>(surface.coefficientCount())),
      slots(static_cast<std::size_t>(surface.slotCount()));
  std::iota(coefficients.begin(), coefficients.end(), 0);
  std::iota(slots.begin(), slots.end(), 0);
  return rowsOf<Scalar>(surface, quadrature, material, {std::nullopt, coefficients, slots},
                        equations, Phase::kAssemble, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const ElementSurface& surface,
                                       const ElementQuadrature& quadrature, const ElementPart& part,
                                       const WeightedEquations& equations, const Material& material,
                                       const Job& job) {
  material.validate();
  return rowsOf<Scalar>(surface, quadrature, material,
                        {part.elements, part.coefficients, part.slots}, equations, std::nullopt,
                        job);
}

template BoundaryOperators<double> assemble(const ElementSurface&, const ElementQuadrature&,
                                            const WeightedEquations&, const Material&, const Job&);
template BoundaryOperators<float> assemble(const ElementSurface&, const ElementQuadrature&,
                                           const WeightedEquations&, const Material&, const Job&);
template BoundaryOperators<double> assemblePart(const ElementSurface&, const ElementQuadrature&,
                                                const ElementPart&, const WeightedEquations&,
                                                const Material&, const Job&);
template BoundaryOperators<float> assemblePart(const ElementSurface&, const ElementQuadrature&,
                                               const ElementPart&, const WeightedEquations&,
                                               const Material&, const Job&);

}  // namespace palpa::bem
