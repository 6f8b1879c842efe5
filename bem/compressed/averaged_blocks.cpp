#include "bem/compressed/averaged_blocks.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

class AveragedBlocks {
 public:
  AveragedBlocks(const CompressedOrder& order, const ElementSurface& surface,
                 const WeightedEquations& equations, const AveragedRows& rows,
                 const std::vector<char>& isWanted)
      : order_(order),
        surface_(surface),
        equations_(equations),
        rows_(rows),
        isWanted_(isWanted),
        columnCount_(order.positionCount() + order.slots.size()) {}

  BlockRows make(std::span<const AveragedRows::Total> totals, const Job& job) {
    setColumns(job);
    result_.blocks.assign(result_.columns.size(), {});
    std::vector<const AveragedElement*> averaged;
    for (const AveragedElement& element : equations_.averaged)
      if (std::any_of(element.equations.begin(), element.equations.end(),
                      [&](int e) { return isWanted_[e]; }))
        averaged.push_back(&element);
    constexpr std::size_t kAtOnce = 256;
    ScratchPool<AveragedRows::Scratch> pool([&] { return rows_.makeScratch(); });
    std::vector<AveragedRows::Blocks> blocks(kAtOnce);
    std::vector<std::vector<std::size_t>> places(2, std::vector<std::size_t>(columnCount_));
    for (std::size_t first = 0; first < averaged.size(); first += kAtOnce) {
      const std::size_t end = std::min(first + kAtOnce, averaged.size());
      parallelFor(static_cast<std::ptrdiff_t>(end - first),
                  partOfJob(job, first, end, averaged.size()), Phase::kAssemble,
                  [&](std::ptrdiff_t k) {
                    AveragedRows::Scratch scratch = pool.take();
                    blocks[k] = rows_.blocks(*averaged[first + k], totals, scratch);
                    pool.giveBack(std::move(scratch));
                  });
      // In the order of the elements, so that the sums do not depend on the number of threads.
      parallelFor(2, job, [&](std::ptrdiff_t half) {
        for (std::size_t k = first; k < end; ++k)
          add(*averaged[k], blocks[k - first], half == 1, places[half]);
      });
    }
    return std::move(result_);
  }

 private:
  int columnOfNode(int node) const { return order_.tree.positionOf()[node]; }
  int columnOfSlot(int slot) const {
    return static_cast<int>(order_.positionCount()) + order_.slotPositionOf[slot];
  }

  /// Memory to list the columns of one equation.
  struct Marks {
    std::vector<int> ofElement, ofColumn;  ///< the equation that listed them last
  };

  /// Columns of an equation: the functions of the near elements and of those left out.
  std::vector<int> columnsOf(int equation, std::span<const AveragedElement* const> elements,
                             Marks& marks) const {
    std::vector<int> columns;
    const auto add = [&](int column) {
      if (std::exchange(marks.ofColumn[column], equation) != equation) columns.push_back(column);
    };
    const auto addAll = [&](std::span<const int> some) {
      for (const int element : some) {
        if (std::exchange(marks.ofElement[element], equation) == equation) continue;
        for (const int node : surface_.coefficients(element)) add(columnOfNode(node));
        for (const int slot : surface_.slots(element)) add(columnOfSlot(slot));
      }
    };
    for (const AveragedElement* element : elements) {
      addAll(element->near);
      for (const int node : element->nodes) addAll(rows_.leftOut(static_cast<std::size_t>(node)));
    }
    std::sort(columns.begin(), columns.end());
    return columns;
  }

  void setColumns(const Job& job) {
    const auto equations = static_cast<std::ptrdiff_t>(equations_.weights.rows());
    std::vector<std::vector<const AveragedElement*>> elements(static_cast<std::size_t>(equations));
    for (const AveragedElement& element : equations_.averaged)
      for (const int e : element.equations)
        if (isWanted_[e]) elements[e].push_back(&element);
    std::vector<std::vector<int>> columns(static_cast<std::size_t>(equations));
    ScratchPool<Marks> pool([&] {
      return Marks{std::vector<int>(static_cast<std::size_t>(surface_.elementCount()), -1),
                   std::vector<int>(columnCount_, -1)};
    });
    constexpr std::ptrdiff_t kPerTask = 64;
    parallelFor((equations + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
      Marks marks = pool.take();
      for (std::ptrdiff_t e = task * kPerTask; e < std::min(equations, (task + 1) * kPerTask); ++e)
        columns[e] = columnsOf(static_cast<int>(e), elements[e], marks);
      pool.giveBack(std::move(marks));
    });
    result_.begin.assign(1, 0);
    for (const auto& list : columns) result_.begin.push_back(result_.begin.back() + list.size());
    result_.columns.reserve(result_.begin.back());
    for (auto& list : columns) {
      result_.columns.insert(result_.columns.end(), list.begin(), list.end());
      list = {};
    }
  }

  /// Adds the columns of nodes or slots. `places`: memory of one number per column.
  void add(const AveragedElement& element, const AveragedRows::Blocks& blocks, bool isOfSlots,
           std::vector<std::size_t>& places) {
    const std::vector<int>& functions = isOfSlots ? blocks.slots : blocks.coefficients;
    const MatrixXd& from = isOfSlots ? blocks.G : blocks.H;
    const double sign = isOfSlots ? 1 : -1;
    for (std::size_t k = 0; k < element.equations.size(); ++k) {
      const auto e = static_cast<std::size_t>(element.equations[k]);
      if (!isWanted_[e]) continue;
      for (std::size_t b = result_.begin[e]; b < result_.begin[e + 1]; ++b)
        places[result_.columns[b]] = b;
      for (std::size_t f = 0; f < functions.size(); ++f) {
        const int column = isOfSlots ? columnOfSlot(functions[f]) : columnOfNode(functions[f]);
        std::array<float, 9>& block = result_.blocks[places[column]];
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c)
            block[3 * i + c] += static_cast<float>(
                sign * from(3 * static_cast<Index>(k) + i, 3 * static_cast<Index>(f) + c));
      }
    }
  }

  const CompressedOrder& order_;
  const ElementSurface& surface_;
  const WeightedEquations& equations_;
  const AveragedRows& rows_;
  const std::vector<char>& isWanted_;
  const std::size_t columnCount_;
  BlockRows result_;
};

}  // namespace

BlockRows makeAveragedBlocks(const CompressedOrder& order, const ElementSurface& surface,
                             const WeightedEquations& equations, const AveragedRows& rows,
                             std::span<const AveragedRows::Total> totals,
                             const std::vector<char>& isWanted, const Job& job) {
  return AveragedBlocks(order, surface, equations, rows, isWanted).make(totals, job);
}

}  // namespace palpa::bem
