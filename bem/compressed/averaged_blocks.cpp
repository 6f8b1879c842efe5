#include "bem/compressed/averaged_blocks.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

class AveragedBlocksMaker {
 public:
  AveragedBlocksMaker(const CompressedOrder& order, const ElementSurface& surface,
                      const WeightedEquations& equations, const AveragedRows& rows,
                      const std::vector<char>& isWanted)
      : order_(order),
        surface_(surface),
        equations_(equations),
        integrals_(rows),
        isWanted_(isWanted),
        columnCount_(order.positionCount() + order.slots.size()) {}

  AveragedBlocks make(std::span<const AveragedRows::Total> totals, const Job& job) {
    const std::vector<const AveragedElement*> averaged = wantedElements();
    setColumns(averaged, job);
    rows_.resize(last_.size());
    constexpr std::size_t kAtOnce = 32;  // of some hundred kilobytes each
    ScratchPool<AveragedRows::Scratch> pool([&] { return integrals_.makeScratch(); });
    std::vector<AveragedRows::Blocks> blocks(kAtOnce);
    std::vector<std::vector<std::size_t>> places(2, std::vector<std::size_t>(columnCount_));
    std::vector<std::size_t> complete;
    for (std::size_t first = 0; first < averaged.size(); first += kAtOnce) {
      const std::size_t end = std::min(first + kAtOnce, averaged.size());
      parallelFor(static_cast<std::ptrdiff_t>(end - first),
                  partOfJob(job, first, end, averaged.size()), Phase::kAssemble,
                  [&](std::ptrdiff_t k) {
                    AveragedRows::Scratch scratch = pool.take();
                    blocks[k] = integrals_.blocks(*averaged[first + k], totals, scratch);
                    pool.giveBack(std::move(scratch));
                  });
      complete.clear();
      for (std::size_t k = first; k < end; ++k)
        for (const int equation : averaged[k]->equations) {
          const auto e = static_cast<std::size_t>(equation);
          if (!isWanted_[e]) continue;
          if (rows_[e].empty()) rows_[e].resize(columnsOfNodes(e) + columnsOfSlots(e));
          if (last_[e] == k) complete.push_back(e);
        }
      // In the order of the elements, so that the sums do not depend on the number of threads.
      parallelFor(2, job, [&](std::ptrdiff_t half) {
        for (std::size_t k = first; k < end; ++k)
          add(*averaged[k], blocks[k - first], half == 1, places[half]);
      });
      parallelFor(static_cast<std::ptrdiff_t>(complete.size()), job,
                  [&](std::ptrdiff_t k) { pack(complete[k]); });
    }
    return std::move(result_);
  }

 private:
  using Row = std::vector<BlockNumbers>;

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
    for (const AveragedElement* element : elements) addAll(element->near);
    std::sort(columns.begin(), columns.end());
    return columns;
  }

  /// Those with wanted equations, neighbours after one another, so that few rows are incomplete at
  /// a time.
  std::vector<const AveragedElement*> wantedElements() const {
    std::vector<std::pair<int, const AveragedElement*>> found;
    for (const AveragedElement& element : equations_.averaged)
      if (std::any_of(element.equations.begin(), element.equations.end(),
                      [&](int e) { return isWanted_[e]; }))
        found.emplace_back(columnOfNode(surface_.coefficients(element.element).front()), &element);
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<const AveragedElement*> elements;
    for (const auto& [position, element] : found) elements.push_back(element);
    return elements;
  }

  /// Numbers of columns of an equation, without the last one among the nodes.
  std::size_t columnsOfNodes(std::size_t e) const {
    const std::size_t all = result_.ofNodes.columns.count(e);
    return all > 0 ? all - 1 : 0;
  }
  std::size_t columnsOfSlots(std::size_t e) const { return result_.ofSlots.columns.count(e); }

  void setColumns(const std::vector<const AveragedElement*>& averaged, const Job& job) {
    const auto equations = static_cast<std::ptrdiff_t>(equations_.weights.rows());
    std::vector<std::vector<const AveragedElement*>> elements(static_cast<std::size_t>(equations));
    last_.resize(elements.size());
    for (std::size_t k = 0; k < averaged.size(); ++k)
      for (const int e : averaged[k]->equations)
        if (isWanted_[e]) {
          elements[e].push_back(averaged[k]);
          last_[e] = k;
        }
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
    const auto nodes = static_cast<int>(order_.positionCount());
    result_.ofNodes.columns.reserve(columns.size());
    result_.ofSlots.columns.reserve(columns.size());
    for (auto& list : columns) {
      const auto split = std::lower_bound(list.begin(), list.end(), nodes);
      const std::vector<int> ofSlots(split, list.end());
      list.erase(split, list.end());
      if (!list.empty()) list.push_back(list.front());  // see packRow()
      result_.ofNodes.columns.appendRow(list);
      result_.ofSlots.columns.appendRow(ofSlots);
      list = std::vector<int>();  // also gives back the memory, unlike an empty list
    }
    result_.ofNodes.columns.shrink();
    result_.ofSlots.columns.shrink();
    result_.ofNodes.blocks.resize(result_.ofNodes.columns.blockCount());
    result_.ofSlots.blocks.resize(result_.ofSlots.columns.blockCount());
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
      const BlockColumns& columns = isOfSlots ? result_.ofSlots.columns : result_.ofNodes.columns;
      // The last block of a row is not in rows_, and repeats the first column until the row is
      // complete.
      const std::size_t firstPlace = isOfSlots ? columnsOfNodes(e) : 0,
                        own = isOfSlots ? columnsOfSlots(e) : columnsOfNodes(e);
      columns.visit(e, [&](std::size_t block, int column) {
        const std::size_t place = block - columns.begin(e);
        if (place < own) places[column] = firstPlace + place;
      });
      for (std::size_t f = 0; f < functions.size(); ++f) {
        const int column = isOfSlots ? columnOfSlot(functions[f]) : columnOfNode(functions[f]);
        BlockNumbers& block = rows_[e][places[column]];
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c)
            block[3 * i + c] += static_cast<float>(
                sign * from(3 * static_cast<Index>(k) + i, 3 * static_cast<Index>(f) + c));
      }
    }
  }

  void pack(std::size_t e) {
    BlockRows<PackedBlock>& nodes = result_.ofNodes;
    BlockRows<PackedSymmetricBlock>& slots = result_.ofSlots;
    const std::span<const BlockNumbers> all(rows_[e]);
    const std::size_t own = columnsOfNodes(e), begin = nodes.columns.begin(e);
    if (own > 0) {
      const std::size_t largest =
          packRow(all.first(own), std::span(nodes.blocks).subspan(begin, own + 1));
      nodes.columns.repeatColumnAtEnd(e, begin + largest);
    }
    std::transform(all.begin() + static_cast<std::ptrdiff_t>(own), all.end(),
                   slots.blocks.begin() + static_cast<std::ptrdiff_t>(slots.columns.begin(e)),
                   packedSymmetric);
    rows_[e] = Row();  // also gives back the memory, unlike an empty list
  }

  const CompressedOrder& order_;
  const ElementSurface& surface_;
  const WeightedEquations& equations_;
  const AveragedRows& integrals_;
  const std::vector<char>& isWanted_;
  const std::size_t columnCount_;
  std::vector<std::size_t> last_;  ///< element of each equation, in order
  std::vector<Row> rows_;          ///< of incomplete equations: blocks of nodes, then of slots
  AveragedBlocks result_;
};

}  // namespace

AveragedBlocks makeAveragedBlocks(const CompressedOrder& order, const ElementSurface& surface,
                                  const WeightedEquations& equations, const AveragedRows& rows,
                                  std::span<const AveragedRows::Total> totals,
                                  const std::vector<char>& isWanted, const Job& job) {
  return AveragedBlocksMaker(order, surface, equations, rows, isWanted).make(totals, job);
}

}  // namespace palpa::bem
