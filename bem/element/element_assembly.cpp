#include "bem/element/element_assembly.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/element/averaged_rows.h"
#include "bem/element/element_rows.h"
#include "bem/model/element_part.h"

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

/// Job whose progress runs over a part of `all`: `some` from `first` on.
Job partOfJob(const Job& job, std::size_t first, std::size_t some, std::size_t all) {
  Job part = job;
  if (job.progress)
    part.progress = [progress = job.progress, from = static_cast<double>(first),
                     size = static_cast<double>(some),
                     whole = static_cast<double>(all)](Phase phase, double fraction) {
      progress(phase, (from + fraction * size) / whole);
    };
  return part;
}

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

/// Rows of points, ordered as [i * count + point]. `integrate`(index, sums): computes the sums of a
/// point.
template <class Scalar, class Integrate>
BoundaryOperators<Scalar> rowsOf(const KelvinConstants& constants, const Columns& columns,
                                 std::size_t count, std::optional<Phase> phase, const Job& job,
                                 const Integrate& integrate) {
  const auto m = static_cast<std::ptrdiff_t>(count);
  const auto triple = [](std::span<const int> some) {
    return 3 * static_cast<Eigen::Index>(some.size());
  };
  BoundaryOperators<Scalar> result{LargeMatrix<Scalar>(3 * m, triple(columns.coefficients)),
                                   LargeMatrix<Scalar>(3 * m, triple(columns.slots))};
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
  return result;
}

/// Number of points whose rows are stored at once before they are added to the rows of equations:
/// small enough for a few MiB, but for many columns at least large enough to keep all threads busy.
/// No columns (an empty part) is a valid number.
std::size_t pointsAtOnce(Eigen::Index columns) {
  constexpr Eigen::Index kNumbers = 4'000'000, kMinRows = 128;
  return static_cast<std::size_t>(
      std::max(kNumbers / std::max<Eigen::Index>(3 * columns, 1), kMinRows));
}

/// Consecutive points whose weights are few equations' or nearly the same, such as all points of an
/// element.
struct PointGroup {
  Eigen::Index first, count;
  std::vector<Eigen::Index> equations;
  Eigen::MatrixXd weights;  ///< (equation, point)
};

/// Groups of the points first … first + count - 1; PointGroup::first is relative to `first`.
std::vector<PointGroup> groupsOf(const Eigen::SparseMatrix<double>& weights, Eigen::Index first,
                                 Eigen::Index count) {
  constexpr std::size_t kEquationsAtMost = 40;
  std::vector<PointGroup> groups;
  std::vector<Eigen::Index> equations, both;
  for (Eigen::Index k = 0; k < count; ++k) {
    equations.clear();
    for (Eigen::SparseMatrix<double>::InnerIterator w(weights, first + k); w; ++w)
      equations.push_back(w.row());
    if (groups.empty()) groups.push_back({k, 0, equations, {}});
    both.clear();
    std::set_union(groups.back().equations.begin(), groups.back().equations.end(),
                   equations.begin(), equations.end(), std::back_inserter(both));
    if (both.size() >
        std::max({kEquationsAtMost, equations.size(), groups.back().equations.size()}))
      groups.push_back({k, 0, equations, {}});
    else
      groups.back().equations = both;
    ++groups.back().count;
  }
  for (PointGroup& group : groups) {
    group.weights.setZero(static_cast<Eigen::Index>(group.equations.size()), group.count);
    for (Eigen::Index k = 0; k < group.count; ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator w(weights, first + group.first + k); w; ++w)
        group.weights(std::lower_bound(group.equations.begin(), group.equations.end(), w.row()) -
                          group.equations.begin(),
                      k) = w.value();
  }
  return groups;
}

constexpr Eigen::Index kColumnsPerTask = 64;

/// Adds the weighted rows of points to the rows of the equations, for some columns.
template <class Scalar>
void addWeighted(const LargeMatrix<Scalar>& ofPoints, const std::vector<PointGroup>& groups,
                 Eigen::Index firstColumn, LargeMatrix<Scalar>& ofEquations) {
  const Eigen::Index points = ofPoints.rows() / 3, equations = ofEquations.rows() / 3,
                     columns = std::min(kColumnsPerTask, ofPoints.cols() - firstColumn);
  auto to = ofEquations.view();
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> weights, sums;
  for (const PointGroup& group : groups) {
    weights = group.weights.cast<Scalar>();
    for (int i = 0; i < 3; ++i) {
      sums.noalias() = weights * ofPoints.view().block(i * points + group.first, firstColumn,
                                                       group.count, columns);
      for (Eigen::Index column = 0; column < columns; ++column)
        for (std::size_t e = 0; e < group.equations.size(); ++e)
          to(i * equations + group.equations[e], firstColumn + column) +=
              sums(static_cast<Eigen::Index>(e), column);
    }
  }
}

/// Adds what averaged elements have near to their equations.
template <class Scalar>
void addNear(const AveragedRows& rows, const WeightedEquations& equations, const Columns& columns,
             const std::vector<AveragedRows::Total>& totals, std::optional<Phase> phase,
             const Job& job, BoundaryOperators<Scalar>& result) {
  const auto count = static_cast<std::ptrdiff_t>(equations.averaged.size());
  // All elements of a batch are added to one column by the same task, in their order: the result
  // does not depend on the number of threads.
  constexpr std::ptrdiff_t kAtOnce = 128, kTasks = 32;
  const auto placesOf = [](std::span<const int> some) {
    return placesIn(some, some.empty() ? 0 : some.back() + 1);
  };
  const std::vector<int> columnsH = placesOf(columns.coefficients),
                         columnsG = placesOf(columns.slots);
  const Eigen::Index rowCount = equations.weights.rows();
  const auto add = [&](const std::vector<int>& of, const Eigen::MatrixXd& blocks,
                       const std::vector<int>& functions, const std::vector<int>& places,
                       std::ptrdiff_t task, LargeMatrix<Scalar>& matrix) {
    for (std::size_t f = 0; f < functions.size(); ++f) {
      if (functions[f] % kTasks != task) continue;
      for (int c = 0; c < 3; ++c) {
        Scalar* column = matrix.data() + (3 * places[functions[f]] + c) * matrix.rows();
        for (std::size_t e = 0; e < of.size(); ++e)
          for (int i = 0; i < 3; ++i)
            column[i * rowCount + of[e]] += static_cast<Scalar>(
                blocks(static_cast<Eigen::Index>(3 * e) + i, static_cast<Eigen::Index>(3 * f) + c));
      }
    }
  };
  ScratchPool<AveragedRows::Scratch> pool([&] { return rows.makeScratch(); });
  std::vector<AveragedRows::Blocks> blocks;
  for (std::ptrdiff_t first = 0; first < count; first += kAtOnce) {
    const std::ptrdiff_t some = std::min(kAtOnce, count - first);
    blocks.resize(static_cast<std::size_t>(some));
    parallelFor(some, partOfJob(job, first, some, count), phase, [&](std::ptrdiff_t k) {
      AveragedRows::Scratch scratch = pool.take();
      blocks[k] = rows.blocks(equations.averaged[first + k], totals, scratch);
      pool.giveBack(std::move(scratch));
    });
    parallelFor(kTasks, job, [&](std::ptrdiff_t task) {
      for (std::ptrdiff_t k = 0; k < some; ++k) {
        const std::vector<int>& of = equations.averaged[first + k].equations;
        add(of, blocks[k].H, blocks[k].coefficients, columnsH, task, result.H);
        add(of, blocks[k].G, blocks[k].slots, columnsG, task, result.G);
      }
    });
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
  const auto rowsOfPoints = [&](std::size_t first, std::size_t count, const Job& ofSome) {
    return rowsOf<Scalar>(
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
        });
  };
  const std::size_t points = equations.points.size();
  if (equations.isCollocation()) return rowsOfPoints(0, points, job);
  const Eigen::Index count = 3 * equations.weights.rows();
  BoundaryOperators<Scalar> result{
      LargeMatrix<Scalar>(count, 3 * static_cast<Eigen::Index>(columns.coefficients.size())),
      LargeMatrix<Scalar>(count, 3 * static_cast<Eigen::Index>(columns.slots.size()))};
  const auto tasksOf = [](const LargeMatrix<Scalar>& matrix) {
    return (matrix.cols() + kColumnsPerTask - 1) / kColumnsPerTask;
  };
  // Measured: an averaged element takes as long as two points.
  const std::size_t all = points + 2 * equations.averaged.size();
  const std::size_t atOnce = pointsAtOnce(result.H.cols() + result.G.cols());
  for (std::size_t first = 0; first < points; first += atOnce) {
    const std::size_t some = std::min(atOnce, points - first);
    const auto ofPoints = rowsOfPoints(first, some, partOfJob(job, first, some, all));
    const std::vector<PointGroup> groups = groupsOf(
        equations.weights, static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(some));
    parallelFor(tasksOf(result.H) + tasksOf(result.G), job, [&](std::ptrdiff_t task) {
      const Eigen::Index ofG = task - tasksOf(result.H);
      if (ofG < 0)
        addWeighted(ofPoints.H, groups, task * kColumnsPerTask, result.H);
      else
        addWeighted(ofPoints.G, groups, ofG * kColumnsPerTask, result.G);
    });
  }
  addNear(averaged, equations, columns, totals, phase, partOfJob(job, points, all - points, all),
          result);
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
