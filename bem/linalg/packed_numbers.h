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
  std::size_t bytes() const { return groups() * bytesPerGroup(); }

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
  bool hasDigits() const { return bits_ != Bits::k8; }
  bool hasMoreDigits() const { return bits_ != Bits::k16; }
  static std::size_t groupsFor(std::size_t size) { return (size + kGroup - 1) / kGroup; }
  std::size_t groups() const { return groupsFor(size_); }
  std::size_t bytesPerGroup() const {
    return (hasDigits() ? 2 * kGroup : 0) + (hasMoreDigits() ? kGroup : 0) + 1;
  }
  std::size_t moreDigitsBegin() const { return hasDigits() ? 2 * kGroup * groups() : 0; }
  std::size_t exponentsBegin() const {
    return moreDigitsBegin() + (hasMoreDigits() ? kGroup * groups() : 0);
  }
  std::uint8_t* data() { return reinterpret_cast<std::uint8_t*>(words_.data()); }
  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(words_.data()); }
  UnpackGroupsTask taskFor(std::size_t first, std::size_t groups, float* to) const;

  std::size_t size_ = 0;
  Bits bits_ = Bits::k16;
  /// One allocation, as a model has hundred thousands of these: 16 digits of each number, or none;
  /// 8 bits that follow these, or all there are, or none; an exponent of each group, see scaleOf().
  std::vector<std::int16_t> words_;
};

}  // namespace palpa::bem
