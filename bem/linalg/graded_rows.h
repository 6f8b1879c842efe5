#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/byte_stream.h"
#include "bem/linalg/packed_numbers.h"
#include "bem/linalg/row_choice.h"

namespace palpa::bem {

/// Matrix whose rows are of falling importance, in 24, 16 or 8 bits per number.
class GradedRows {
 public:
  GradedRows() = default;
  /// `bits` of each row, falling.
  GradedRows(const RowMatrixXf& rows, std::span<const PackedNumbers::Bits> bits);

  int rowCount() const { return rows_[0] + rows_[1] + rows_[2]; }
  std::size_t bytes() const;

  /// Numbers of all rows in memory that the caller keeps for the next call.
  struct Unpacked {
    const float* numbers;  ///< [row * stride + column - begin]
    int stride;
  };
  /// Columns `begin`, …, `begin + count - 1`.
  Unpacked unpack(int begin, int count, std::vector<float>& scratch) const;

  void write(const ByteSink& sink) const;
  /// Reads a matrix of this size. Throws DamagedData, and what the source throws.
  static GradedRows read(int rows, int columns, const ByteSource& source);

 private:
  static constexpr std::array kBits{PackedNumbers::Bits::k24, PackedNumbers::Bits::k16,
                                    PackedNumbers::Bits::k8};
  std::size_t groupsPerRow_ = 0;          ///< each row begins with a group
  std::array<int, kBits.size()> rows_{};  ///< with each number of bits
  std::array<PackedNumbers, kBits.size()> numbers_;
};

}  // namespace palpa::bem
