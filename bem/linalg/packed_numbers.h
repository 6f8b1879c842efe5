#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/byte_stream.h"
#include "bem/linalg/unpack_groups.h"

namespace palpa::bem {

/// Largest magnitude; infinite if a number is not finite.
float largestMagnitude(std::span<const float> numbers);

/// Numbers of single precision in about 8, 16 or 24 bits each: groups of kGroup have a common
/// exponent (block floating point). Each number is within 2^-7, 2^-15 or 2^-23 of the largest
/// magnitude of its group. Numbers below 2^-111 become zero; a group with a number that is not
/// finite has no finite numbers.
class PackedNumbers {
 public:
  static constexpr std::size_t kGroup = 16;
  enum class Bits { k8, k16, k24 };

  PackedNumbers() = default;
  explicit PackedNumbers(std::span<const float> numbers, Bits bits = Bits::k16);
  /// The numbers of a dense matrix in their order.
  template <class Matrix>
  requires std::is_base_of_v<Eigen::PlainObjectBase<Matrix>, Matrix>
  explicit PackedNumbers(const Matrix& matrix, Bits bits = Bits::k16)
      : PackedNumbers({matrix.data(), static_cast<std::size_t>(matrix.size())}, bits) {}

  std::size_t size() const { return size_; }
  std::size_t bytes() const {
    return digits_.size() * sizeof(std::int16_t) + moreDigits_.size() + exponents_.size();
  }

  /// Numbers `begin`, …, `begin + count - 1`, in memory that the caller keeps for the next call.
  const float* unpack(std::size_t begin, std::size_t count, std::vector<float>& scratch) const;
  const float* unpack(std::vector<float>& scratch) const { return unpack(0, size_, scratch); }
  /// Writes whole groups, kGroup numbers each; behind the numbers there are zeros.
  void unpackGroupsTo(std::size_t first, std::size_t groups, float* to) const;
  /// Writes all numbers.
  void unpackTo(float* to) const;

  void write(const ByteSink& sink) const;
  /// Reads `size` numbers that write() wrote. Throws what the source throws.
  static PackedNumbers read(std::size_t size, Bits bits, const ByteSource& source);

 private:
  PackedNumbers(std::size_t size, Bits bits);
  UnpackGroupsTask taskFor(std::size_t first, std::size_t groups, float* to) const;

  std::size_t size_ = 0;
  std::vector<std::int16_t> digits_;      ///< whole groups, or empty
  std::vector<std::uint8_t> moreDigits_;  ///< 8 bits that follow these, or all there are, or empty
  std::vector<std::uint8_t> exponents_;   ///< of each group, see scaleOf()
};

}  // namespace palpa::bem
