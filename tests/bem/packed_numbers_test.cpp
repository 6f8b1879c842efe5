// Numbers of 8 to 24 bits with common exponents, and rows of packed blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/byte_reader.h"
#include "bem/compressed/block_rows.h"
#include "bem/linalg/packed_numbers.h"
#include "bem/linalg/unpack_groups.h"

namespace palpa::bem {
namespace {

/// Numbers of both signs whose magnitudes range over many powers of ten.
std::vector<float> numbersOfAllSizes(std::size_t count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> digits(-1, 1), power(-20, 20);
  std::vector<float> numbers;
  for (std::size_t k = 0; k < count; ++k)
    numbers.push_back(digits(generator) * std::pow(10.0F, power(generator)));
  return numbers;
}

using Bits = PackedNumbers::Bits;

TEST(PackedNumbers, AreWithinTheirBoundOfTheLargestInTheirGroup) {
  const std::vector<float> numbers = numbersOfAllSizes(1003);  // the last group is not complete
  for (const auto& [bits, digits, bytes] :
       {std::tuple{Bits::k8, 7, 1.2}, {Bits::k16, 15, 2.2}, {Bits::k24, 23, 3.2}}) {
    const PackedNumbers packed(numbers, bits);
    EXPECT_EQ(packed.size(), numbers.size());
    EXPECT_LT(static_cast<double>(packed.bytes()), bytes * static_cast<double>(numbers.size()));
    std::vector<float> all(numbers.size()), scratch;
    packed.unpackTo(all.data());
    for (std::size_t group = 0; group < numbers.size(); group += PackedNumbers::kGroup) {
      const std::size_t end = std::min(group + PackedNumbers::kGroup, numbers.size());
      float largest = 0;
      for (std::size_t k = group; k < end; ++k) largest = std::max(largest, std::abs(numbers[k]));
      for (std::size_t k = group; k < end; ++k)
        EXPECT_LE(std::abs(all[k] - numbers[k]), std::ldexp(largest, -digits)) << k;
    }
    for (const auto& [begin, count] : {std::pair{0, 5}, {7, 40}, {16, 16}, {990, 13}, {40, 0}}) {
      const float* some =
          packed.unpack(static_cast<std::size_t>(begin), static_cast<std::size_t>(count), scratch);
      for (int k = 0; k < count; ++k) EXPECT_EQ(some[k], all[static_cast<std::size_t>(begin + k)]);
    }
  }
}

TEST(PackedNumbers, KeepWholeNumbersUpTo15Bits) {
  std::vector<float> numbers;
  for (int k = -16; k < 16; ++k) numbers.push_back(static_cast<float>(2047 * k));
  std::vector<float> all(numbers.size());
  PackedNumbers(numbers).unpackTo(all.data());
  EXPECT_EQ(all, numbers);
}

TEST(PackedNumbers, KeepZeroAndDoNotHideWhatIsNotFinite) {
  for (const Bits bits : {Bits::k8, Bits::k16, Bits::k24}) {
    std::vector<float> numbers(PackedNumbers::kGroup, 1.0F), all(numbers.size());
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
      numbers[3] = bad;
      PackedNumbers(numbers, bits).unpackTo(all.data());
      EXPECT_FALSE(std::isfinite(all[3]));
    }
    const std::vector<float> zeros(40, 0.0F);
    all.assign(zeros.size(), 1.0F);
    PackedNumbers(zeros, bits).unpackTo(all.data());
    EXPECT_EQ(all, zeros);
    const float most = std::numeric_limits<float>::max();
    PackedNumbers(std::vector<float>{most}, bits).unpackTo(all.data());
    EXPECT_NEAR(all[0] / most, 1, bits == Bits::k8 ? 0x1p-7 : 1e-4);
  }
}

TEST(PackedNumbers, AreReadAsTheyWereWritten) {
  for (const Bits bits : {Bits::k8, Bits::k16, Bits::k24}) {
    const PackedNumbers packed(numbersOfAllSizes(100), bits);
    std::vector<std::byte> stored;
    packed.write([&](std::span<const std::byte> bytes) {
      stored.insert(stored.end(), bytes.begin(), bytes.end());
    });
    EXPECT_EQ(stored.size(), packed.bytes());
    std::span<const std::byte> left(stored);
    const PackedNumbers read = PackedNumbers::read(100, bits, [&](std::span<std::byte> to) {
      std::copy_n(left.begin(), to.size(), to.begin());
      left = left.subspan(to.size());
    });
    EXPECT_TRUE(left.empty());
    std::vector<float> a(100), b(100);
    packed.unpackTo(a.data());
    read.unpackTo(b.data());
    EXPECT_EQ(a, b);
  }
}

TEST(PackedNumbers, AreTheSameWithEveryInstructionSet) {
  std::vector<std::int16_t> digits;
  std::vector<std::uint8_t> more;
  for (int k = 0; k < 3 * static_cast<int>(PackedNumbers::kGroup); ++k) {
    digits.push_back(static_cast<std::int16_t>(700 * k - 16000));
    more.push_back(static_cast<std::uint8_t>(37 * k + 11));
  }
  const std::vector<std::uint8_t> exponents{90, 0, 140};
  const std::int16_t* const noDigits = nullptr;
  const std::uint8_t* const noMore = nullptr;
  for (const auto& [someDigits, moreDigits] :
       {std::pair{noDigits, static_cast<const std::uint8_t*>(more.data())},
        {static_cast<const std::int16_t*>(digits.data()), noMore},
        {digits.data(), more.data()}}) {
    std::vector<float> baseline(digits.size()), fastest(digits.size());
    unpackGroupsBaseline({someDigits, moreDigits, exponents.data(), 3, baseline.data()});
    unpackGroupsForThisProcessor()({someDigits, moreDigits, exponents.data(), 3, fastest.data()});
    EXPECT_EQ(baseline, fastest);
    EXPECT_NE(baseline[0], 0);
    EXPECT_EQ(baseline[PackedNumbers::kGroup], 0);
  }
}

TEST(PackedRow, KeepsTheSumOfTheBlocks) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> anyNumber(-8, 8);
  std::vector<BlockNumbers> blocks(8);
  for (auto& block : blocks)
    for (float& number : block) number = anyNumber(generator);
  std::vector<PackedBlock> packed(blocks.size() + 1);
  EXPECT_LT(packRow(blocks, packed), blocks.size());
  for (std::size_t k = 0; k < 9; ++k) {
    double expected = 0, rounded = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      expected += static_cast<double>(blocks[b][k]);
      rounded += static_cast<double>(numbersOf(packed[b])[k]);
    }
    const double sum = rounded + static_cast<double>(numbersOf(packed.back())[k]);
    EXPECT_NEAR(sum, expected, 1e-7);
    EXPECT_NEAR(rounded, expected, 1e-3);
  }
}

TEST(PackedSymmetricBlock, IsTheSymmetricPart) {
  const BlockNumbers numbers{8, 1.5F, -2, 0.5F, 4, 3, -4, 2, -1};
  const BlockNumbers expected{8, 1, -3, 1, 4, 2.5F, -3, 2.5F, -1};
  const BlockNumbers found = numbersOf(packedSymmetric(numbers));
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(found[k], expected[k], 8 * 0x1p-15) << k;
  EXPECT_EQ(numbersOf(packedSymmetric({})), BlockNumbers{});
  EXPECT_TRUE(std::isnan(numbersOf(packedSymmetric({INFINITY}))[4]));
}

TEST(BlockColumns, KeepRowsAsRuns) {
  BlockColumns columns;
  columns.appendRow(std::vector<int>{2, 3, 4, 9, 2});
  columns.appendRow(std::vector<int>{});
  columns.appendRow(std::vector<int>{5, 5});
  const auto row = [](const BlockColumns& some, std::size_t k) {
    std::vector<int> found;
    some.visit(k, [&](std::size_t number, int column) {
      EXPECT_EQ(number, some.begin(k) + found.size());
      found.push_back(column);
    });
    EXPECT_EQ(found.size(), some.count(k));
    return found;
  };
  columns.repeatColumnAtEnd(0, 3);
  EXPECT_EQ(row(columns, 0), (std::vector{2, 3, 4, 9, 9}));
  columns.repeatColumnAtEnd(0, 1);
  EXPECT_EQ(row(columns, 0), (std::vector{2, 3, 4, 9, 3}));
  EXPECT_EQ(columns.runs(0).size(), 3U);
  EXPECT_EQ(row(columns, 1), std::vector<int>{});
  EXPECT_EQ(row(columns, 2), (std::vector{5, 5}));
  EXPECT_EQ(columns.blockCount(), 7U);

  std::vector<std::byte> stored;
  columns.write([&](std::span<const std::byte> bytes) {
    stored.insert(stored.end(), bytes.begin(), bytes.end());
  });
  const auto readBack = [&](std::size_t rows, int columnCount) {
    std::span<const std::byte> rest(stored);
    return BlockColumns::read(
        [&](std::span<std::byte> to) {
          std::copy_n(rest.begin(), to.size(), to.begin());
          rest = rest.subspan(to.size());
        },
        rows, columnCount);
  };
  const BlockColumns again = readBack(3, 10);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(row(again, k), row(columns, k));
  EXPECT_THROW(readBack(2, 10), DamagedData);
  EXPECT_THROW(readBack(3, 9), DamagedData);

  // A run has at most 255 columns.
  std::vector<int> many(600);
  std::iota(many.begin(), many.end(), ColumnRun::kMaxColumns - 600);
  columns.appendRow(many);
  EXPECT_EQ(row(columns, 3), many);
  EXPECT_EQ(columns.runs(3).size(), 3U);
}

}  // namespace
}  // namespace palpa::bem
