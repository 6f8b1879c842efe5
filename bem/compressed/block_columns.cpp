#include "bem/compressed/block_columns.h"

#include <algorithm>

#include "base/byte_reader.h"

namespace palpa::bem {

void BlockColumns::reserve(std::size_t rows) {
  firstBlock_.reserve(rows + 1);
  firstRun_.reserve(rows + 1);
}

void BlockColumns::appendRow(std::span<const int> columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0 && columns[k] == columns[k - 1] + 1 && runs_.back().count < ColumnRun::kMaxCount)
      ++runs_.back().count;
    else
      runs_.push_back({static_cast<std::uint32_t>(columns[k]), 1});
  }
  firstBlock_.push_back(firstBlock_.back() + columns.size());
  firstRun_.push_back(runs_.size());
}

void BlockColumns::appendRow(std::span<const ColumnRun> first, std::span<const ColumnRun> second) {
  std::size_t count = 0;
  for (const auto& some : {first, second})
    for (const ColumnRun& run : some) {
      runs_.push_back(run);
      count += run.count;
    }
  firstBlock_.push_back(firstBlock_.back() + count);
  firstRun_.push_back(runs_.size());
}

void BlockColumns::repeatColumnAtEnd(std::size_t row, std::size_t number) {
  visit(row, [&](std::size_t block, int column) {
    if (block == number) runs_[firstRun_[row + 1] - 1].first = static_cast<std::uint32_t>(column);
  });
}

void BlockColumns::shrink() {
  runs_.shrink_to_fit();
}

std::size_t BlockColumns::bytes() const {
  return (firstBlock_.size() + firstRun_.size()) * sizeof(std::size_t) +
         runs_.size() * sizeof(ColumnRun);
}

void BlockColumns::write(const ByteSink& sink) const {
  writeList(sink, firstRun_);
  writeList(sink, runs_);
}

BlockColumns BlockColumns::read(const ByteSource& source, std::size_t rows, int columnCount) {
  const auto firstRun = readList<std::size_t>(source);
  const auto runs = readList<ColumnRun>(source);
  if (firstRun.size() != rows + 1 || firstRun.front() != 0 || firstRun.back() != runs.size() ||
      !std::is_sorted(firstRun.begin(), firstRun.end()))
    throw DamagedData();
  for (const ColumnRun& run : runs)
    if (run.count < 1 || static_cast<int>(run.first + run.count) > columnCount) throw DamagedData();
  BlockColumns columns;
  columns.reserve(rows);
  for (std::size_t row = 0; row < rows; ++row)
    columns.appendRow(std::span(runs).subspan(firstRun[row], firstRun[row + 1] - firstRun[row]),
                      {});
  return columns;
}

}  // namespace palpa::bem
