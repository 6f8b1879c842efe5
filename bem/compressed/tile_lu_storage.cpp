#include <algorithm>
#include <cstring>

#include "base/byte_reader.h"
#include "bem/base/team_data.h"
#include "bem/compressed/tile_lu.h"
#include "bem/linalg/blas_threads.h"

namespace palpa::bem {

void TileLu::writeTile(int row, int column, const ByteSink& sink) const {
  const PackedTile& of = tile(row, column);
  writeValue(sink, of.rank);
  writeValue(sink, of.rankOfY);
  writeValue(sink, of.smallSummands);
  for (const PackedNumbers* numbers : {&of.smallX, &of.smallY, &of.X, &of.Y}) numbers->write(sink);
}

void TileLu::readTile(int row, int column, const ByteSource& source) {
  const int rank = readValue<int>(source), rankOfY = readValue<int>(source),
            small = readValue<int>(source);
  const bool isDense = rankOfY == 0;
  if (rank < 0 || (isDense ? rank != 0 && rank != sizes_[column] : rank != rankOfY) ||
      rank > std::max(sizes_[row], sizes_[column]) || small < 0 || small > rankOfY)
    throw DamagedData();
  using Bits = PackedNumbers::Bits;
  const auto numbers = [&](int rows, int columns, Bits bits) {
    return PackedNumbers::read(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns),
                               bits, source);
  };
  PackedTile& to = tile(row, column);
  to.rank = rank;
  to.rankOfY = rankOfY;
  to.smallSummands = small;
  to.smallX = numbers(sizes_[row], small, Bits::k8);
  to.smallY = numbers(sizes_[column], small, Bits::k8);
  to.X = numbers(sizes_[row], rank - small, Bits::k16);
  to.Y = numbers(sizes_[column], rankOfY - small, Bits::k16);
}

void TileLu::write(const ByteSink& sink) const {
  writeList(sink, sizes_);
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column) writeTile(row, column, sink);
  for (const auto& pivots : pivots_) writeList(sink, pivots);
  writeNumbers(sink, columnScales_);
  writeValue(sink, norm1_);
}

TileLu::TileLu(Eigen::Index size, const ByteSource& source)
    : sizes_(readList<int>(source)), tolerance_(0), pivots_(sizes_.size()) {
  useOneBlasThread();
  begins_.push_back(0);
  for (const int each : sizes_) {
    if (each < 1 || each > size) throw DamagedData();
    begins_.push_back(begins_.back() + each);
  }
  if (begins_.back() != size) throw DamagedData();
  tiles_.resize(sizes_.size() * sizes_.size());
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column) readTile(row, column, source);
  for (int k = 0; k < count(); ++k) {
    pivots_[k] = readList<int>(source);
    if (pivots_[k].size() != static_cast<std::size_t>(sizes_[k])) throw DamagedData();
  }
  columnScales_.resize(size);
  readNumbers(source, columnScales_);
  norm1_ = readValue<double>(source);
}

void TileLu::shareStep(int k, const Team& team) {
  Team::Bytes own;
  const auto others = [&](int member, const auto& visit) {
    for (int other = k + 1; other < count(); ++other)
      if (other % team.count() == member) {
        visit(other, k);
        visit(k, other);
      }
  };
  others(team.index(), [&](int row, int column) {
    writeTile(row, column, [&](std::span<const std::byte> bytes) {
      own.insert(own.end(), bytes.begin(), bytes.end());
    });
  });
  const std::vector<Team::Bytes> all = team.gather(own);
  for (int m = 0; m < team.count(); ++m) {
    if (m == team.index()) continue;
    std::span<const std::byte> left(all[m]);
    others(m, [&](int row, int column) {
      readTile(row, column, [&](std::span<std::byte> to) {
        if (to.size() > left.size()) throw DamagedData();
        std::copy_n(left.begin(), to.size(), to.begin());
        left = left.subspan(to.size());
      });
    });
  }
}

}  // namespace palpa::bem
