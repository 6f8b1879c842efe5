#include "bem/linalg/packed_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/byte_reader.h"

namespace palpa::bem {

namespace {

constexpr int kDigits = 15, kMoreDigits = 8, kFewDigits = 7, kBias = 127, kMantissaBits = 23;
constexpr std::uint8_t kNotFinite = 255;

void unpackGroups(const UnpackGroupsTask& task) {
  static const UnpackGroups fastest = unpackGroupsForThisProcessor();
  fastest(task);
}

/// Factor of the digits of a group: the number of single precision with this exponent field.
float scaleOf(std::uint8_t exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent) << kMantissaBits);
}

/// Exponent with which numbers of magnitude `largest` have digits of 15 bits.
std::uint8_t exponentFor(float largest) {
  if (!std::isfinite(largest)) return kNotFinite;
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest < 2^exponent
  return static_cast<std::uint8_t>(largest == 0 ? 0 : std::max(0, exponent - kDigits + kBias));
}

/// Digits of a number of a group with this exponent.
std::int16_t digitsOf(float number, std::uint8_t exponent) {
  if (exponent == 0) return 0;
  if (exponent == kNotFinite) return 1;
  constexpr float kMaxDigits = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(
      std::clamp(std::nearbyint(number / scaleOf(exponent)), -kMaxDigits, kMaxDigits));
}

/// Digits of 23 bits, as digitsOf() gives 15.
std::int32_t manyDigitsOf(float number, std::uint8_t exponent) {
  if (exponent == 0) return 0;
  if (exponent == kNotFinite) return 1 << kMoreDigits;
  constexpr double kMaxDigits = (1 << (kDigits + kMoreDigits)) - 1;
  const double scale = static_cast<double>(scaleOf(exponent)) / (1 << kMoreDigits);
  return static_cast<std::int32_t>(
      std::clamp(std::nearbyint(static_cast<double>(number) / scale), -kMaxDigits, kMaxDigits));
}

/// Digits of 7 bits and the sign, as digitsOf() gives 15.
std::uint8_t fewDigitsOf(float number, std::uint8_t exponent) {
  if (exponent == 0) return 0;
  if (exponent == kNotFinite) return 1;
  constexpr float kMaxDigits = (1 << kFewDigits) - 1;
  const float scale = scaleOf(exponent) * (1 << (kDigits - kFewDigits));
  return static_cast<std::uint8_t>(static_cast<std::int8_t>(
      std::clamp(std::nearbyint(number / scale), -kMaxDigits, kMaxDigits)));
}

}  // namespace

float largestMagnitude(std::span<const float> numbers) {
  float largest = 0;
  for (const float number : numbers) {
    if (!std::isfinite(number)) return std::numeric_limits<float>::infinity();
    largest = std::max(largest, std::abs(number));
  }
  return largest;
}

PackedNumbers::PackedNumbers(std::size_t size, Bits bits) : size_(size), bits_(bits) {
  words_.resize((bytes() + 1) / 2);
}

PackedNumbers::PackedNumbers(std::span<const float> numbers, Bits bits)
    : PackedNumbers(numbers.size(), bits) {
  std::int16_t* const digits = words_.data();
  std::uint8_t* const moreDigits = data() + moreDigitsBegin();
  std::uint8_t* const exponents = data() + exponentsBegin();
  for (std::size_t group = 0; group < groups(); ++group) {
    const std::size_t begin = group * kGroup, end = std::min(begin + kGroup, size_);
    const std::uint8_t exponent = exponents[group] =
        exponentFor(largestMagnitude(numbers.subspan(begin, end - begin)));
    for (std::size_t k = begin; k < end; ++k) {
      if (bits == Bits::k8) {
        moreDigits[k] = fewDigitsOf(numbers[k], exponent);
      } else if (bits == Bits::k16) {
        digits[k] = digitsOf(numbers[k], exponent);
      } else {
        const std::int32_t all = manyDigitsOf(numbers[k], exponent);
        digits[k] = static_cast<std::int16_t>(all >> kMoreDigits);  // rounds down
        moreDigits[k] = static_cast<std::uint8_t>(all & ((1 << kMoreDigits) - 1));
      }
    }
  }
}

UnpackGroupsTask PackedNumbers::taskFor(std::size_t first, std::size_t groups, float* to) const {
  return {hasDigits() ? words_.data() + first * kGroup : nullptr,
          hasMoreDigits() ? data() + moreDigitsBegin() + first * kGroup : nullptr,
          data() + exponentsBegin() + first, groups, to};
}

void PackedNumbers::unpackGroupsTo(std::size_t first, std::size_t groups, float* to) const {
  if (groups > 0) unpackGroups(taskFor(first, groups, to));
}

void PackedNumbers::unpackTo(float* to) const {
  const std::size_t whole = size_ / kGroup, begin = whole * kGroup;
  unpackGroups(taskFor(0, whole, to));
  if (begin == size_) return;
  std::array<float, kGroup> rest;
  unpackGroups(taskFor(whole, 1, rest.data()));
  std::copy_n(rest.begin(), size_ - begin, to + begin);
}

const float* PackedNumbers::unpack(std::size_t begin, std::size_t count,
                                   std::vector<float>& scratch) const {
  const std::size_t first = begin / kGroup, groups = groupsFor(begin + count) - first;
  if (scratch.size() < groups * kGroup) scratch.resize(groups * kGroup);
  unpackGroups(taskFor(first, groups, scratch.data()));
  return scratch.data() + begin % kGroup;
}

void PackedNumbers::write(const ByteSink& sink) const {
  sink(std::as_bytes(std::span(words_)).first(bytes()));
}

PackedNumbers PackedNumbers::read(std::size_t size, Bits bits, const ByteSource& source) {
  PackedNumbers numbers(size, bits);
  source(std::as_writable_bytes(std::span(numbers.words_)).first(numbers.bytes()));
  return numbers;
}

}  // namespace palpa::bem
