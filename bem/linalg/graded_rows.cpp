#include "bem/linalg/graded_rows.h"

#include <algorithm>

#include "base/byte_reader.h"

namespace palpa::bem {

namespace {

constexpr std::size_t kGroup = PackedNumbers::kGroup;

std::size_t groupsFor(Eigen::Index columns) {
  return (static_cast<std::size_t>(columns) + kGroup - 1) / kGroup;
}

}  // namespace

GradedRows::GradedRows(const RowMatrixXf& rows, std::span<const PackedNumbers::Bits> bits)
    : groupsPerRow_(groupsFor(rows.cols())) {
  Eigen::Index first = 0;
  for (std::size_t part = 0; part < kBits.size(); ++part) {
    const auto count = std::count(bits.begin(), bits.end(), kBits[part]);
    RowMatrixXf whole = RowMatrixXf::Zero(count, static_cast<Eigen::Index>(groupsPerRow_ * kGroup));
    whole.leftCols(rows.cols()) = rows.middleRows(first, count);
    rows_[part] = static_cast<int>(count);
    numbers_[part] = PackedNumbers(whole, kBits[part]);
    first += count;
  }
}

std::size_t GradedRows::bytes() const {
  std::size_t sum = 0;
  for (const PackedNumbers& part : numbers_) sum += part.bytes();
  return sum;
}

GradedRows::Unpacked GradedRows::unpack(int begin, int count, std::vector<float>& scratch) const {
  const std::size_t first = static_cast<std::size_t>(begin) / kGroup,
                    groups = groupsFor(begin + count) - first, stride = groups * kGroup;
  const std::size_t size = static_cast<std::size_t>(rowCount()) * stride;
  if (scratch.size() < size) scratch.resize(size);
  float* to = scratch.data();
  for (std::size_t part = 0; part < kBits.size(); ++part) {
    const auto rows = static_cast<std::size_t>(rows_[part]);
    if (groups == groupsPerRow_) {
      numbers_[part].unpackGroupsTo(0, rows * groups, to);
    } else {
      for (std::size_t row = 0; row < rows; ++row)
        numbers_[part].unpackGroupsTo(row * groupsPerRow_ + first, groups, to + row * stride);
    }
    to += rows * stride;
  }
  return {scratch.data() + static_cast<std::size_t>(begin) % kGroup, static_cast<int>(stride)};
}

void GradedRows::write(const ByteSink& sink) const {
  for (const int rows : rows_) writeValue(sink, rows);
  for (const PackedNumbers& part : numbers_) part.write(sink);
}

GradedRows GradedRows::read(int rows, int columns, const ByteSource& source) {
  GradedRows result;
  result.groupsPerRow_ = groupsFor(columns);
  int rest = rows;
  for (int& count : result.rows_) {
    count = readValue<int>(source);
    if (count < 0 || count > rest) throw DamagedData();
    rest -= count;
  }
  if (rest != 0) throw DamagedData();
  for (std::size_t part = 0; part < kBits.size(); ++part)
    result.numbers_[part] = PackedNumbers::read(
        static_cast<std::size_t>(result.rows_[part]) * result.groupsPerRow_ * kGroup, kBits[part],
        source);
  return result;
}

}  // namespace palpa::bem
