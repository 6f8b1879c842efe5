#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/byte_stream.h"
#include "bem/compressed/packed_block.h"

namespace palpa::bem {

/// Columns of the blocks of a sparse matrix, row after row. A row may have a column several times.
class BlockColumns {
 public:
  std::size_t rowCount() const { return firstBlock_.size() - 1; }
  std::size_t blockCount() const { return firstBlock_.back(); }
  /// Number of the first block of a row among the blocks of all rows.
  std::size_t begin(std::size_t row) const { return firstBlock_[row]; }
  std::size_t count(std::size_t row) const { return firstBlock_[row + 1] - firstBlock_[row]; }
  std::span<const ColumnRun> runs(std::size_t row) const {
    return std::span(runs_).subspan(firstRun_[row], firstRun_[row + 1] - firstRun_[row]);
  }
  /// Calls visit(number of a block, column) for the blocks of a row.
  template <class Visit>
  void visit(std::size_t row, const Visit& visit) const {
    std::size_t block = firstBlock_[row];
    for (const ColumnRun& run : runs(row))
      for (int k = 0; k < run.count; ++k) visit(block++, static_cast<int>(run.first) + k);
  }

  void reserve(std::size_t rows);
  /// Appends a row with a block in each of these columns, in this order; below
  /// ColumnRun::kMaxColumns.
  void appendRow(std::span<const int> columns);
  /// Appends a row with the blocks of both.
  void appendRow(std::span<const ColumnRun> first, std::span<const ColumnRun> second);
  /// Gives the last block of a row, whose column does not follow the one before, the column of
  /// block `number` of all.
  void repeatColumnAtEnd(std::size_t row, std::size_t number);

  /// Frees the memory kept for further rows.
  void shrink();
  std::size_t bytes() const;
  void write(const ByteSink& sink) const;
  /// Columns below `columnCount`. Throws DamagedData, and what the source throws.
  static BlockColumns read(const ByteSource& source, std::size_t rows, int columnCount);

 private:
  std::vector<std::size_t> firstBlock_{0}, firstRun_{0};  ///< of each row, and the end
  std::vector<ColumnRun> runs_;
};

}  // namespace palpa::bem
