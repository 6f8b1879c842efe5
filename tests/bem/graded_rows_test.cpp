// Matrices with rows of falling importance, and products of narrow matrices packed as such.
#include "bem/linalg/graded_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "base/byte_reader.h"
#include "bem/compressed/graded_factors.h"

namespace palpa::bem {
namespace {

using Bits = PackedNumbers::Bits;
using Eigen::Index;

RowMatrixXf randomMatrix(Index rows, Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  RowMatrixXf matrix(rows, columns);
  for (Index k = 0; k < matrix.size(); ++k) matrix.data()[k] = uniform(generator);
  return matrix;
}

RowMatrixXf columnsOf(const GradedRows& rows, int begin, int count) {
  std::vector<float> scratch;
  const GradedRows::Unpacked unpacked = rows.unpack(begin, count, scratch);
  RowMatrixXf matrix(rows.rowCount(), count);
  for (Index r = 0; r < matrix.rows(); ++r)
    for (Index c = 0; c < count; ++c) matrix(r, c) = unpacked.numbers[r * unpacked.stride + c];
  return matrix;
}

constexpr std::array kRowBits{Bits::k24, Bits::k24, Bits::k16, Bits::k8, Bits::k8};

TEST(GradedRows, AnyColumnsAreTheRoundedNumbers) {
  const RowMatrixXf numbers = randomMatrix(5, 71, 1);
  const GradedRows rows(numbers, kRowBits);
  ASSERT_EQ(rows.rowCount(), 5);
  EXPECT_LT(rows.bytes(), 11U * (80 + 5));
  const RowMatrixXf all = columnsOf(rows, 0, 71);
  const std::array errors{0x1p-23F, 0x1p-23F, 0x1p-15F, 0x1p-7F, 0x1p-7F};
  for (Index r = 0; r < 5; ++r)
    EXPECT_LE((all - numbers).row(r).cwiseAbs().maxCoeff(), errors[static_cast<std::size_t>(r)])
        << r;
  for (const auto& [begin, count] : {std::pair{0, 16}, {3, 1}, {15, 2}, {17, 54}, {70, 1}})
    EXPECT_EQ(columnsOf(rows, begin, count), all.middleCols(begin, count)) << begin;
}

TEST(GradedRows, AreReadAsTheyWereWritten) {
  const GradedRows rows(randomMatrix(5, 30, 2), kRowBits);
  std::vector<std::byte> stored;
  rows.write([&](std::span<const std::byte> bytes) {
    stored.insert(stored.end(), bytes.begin(), bytes.end());
  });
  const auto readBack = [&](int rowCount) {
    std::span<const std::byte> rest(stored);
    return GradedRows::read(rowCount, 30, [&](std::span<std::byte> to) {
      if (to.size() > rest.size()) throw DamagedData();
      std::copy_n(rest.begin(), to.size(), to.begin());
      rest = rest.subspan(to.size());
    });
  };
  EXPECT_EQ(columnsOf(readBack(5), 0, 30), columnsOf(rows, 0, 30));
  EXPECT_THROW(readBack(4), DamagedData);
  EXPECT_THROW(readBack(6), DamagedData);
}

/// Both factors are full of numbers of the same size, the product is of falling summands.
TEST(GradedFactors, TakeLessMemoryAndKeepTheProduct) {
  constexpr Index kSummands = 24, kHeight = 200, kWidth = 300, kLast = 101;
  RowMatrixXf mixing = randomMatrix(kSummands, kSummands, 5);
  mixing.diagonal().array() += 5;
  RowMatrixXf falling = randomMatrix(kSummands, kWidth, 3);
  for (Index r = 0; r < kSummands; ++r)
    falling.row(r) *= std::pow(2.0F, -0.7F * static_cast<float>(r));
  const RowMatrixXf V = mixing * falling, U = randomMatrix(kSummands, kHeight, 4);
  const GradedFactors factors = gradedFactors(U, V, kLast, 1);
  const Eigen::MatrixXd expected = U.cast<double>().transpose() * V.cast<double>();
  const auto found = [&](const GradedFactors& some) {
    Eigen::MatrixXd factor(some.V1.rowCount(), kWidth);
    factor << columnsOf(some.V1, 0, kWidth - kLast).cast<double>(),
        columnsOf(some.V2, 0, kLast).cast<double>();
    return Eigen::MatrixXd(columnsOf(some.U, 0, kHeight).cast<double>().transpose() * factor);
  };
  EXPECT_LT((found(factors) - expected).norm(), 5e-5 * expected.norm());
  const auto bytes = factors.U.bytes() + factors.V1.bytes() + factors.V2.bytes();
  EXPECT_LT(static_cast<double>(bytes), 2.2 * kSummands * (kHeight + kWidth));

  // Columns of small numbers that matter as much as the others are as exact.
  RowMatrixXf mixed = V;
  mixed.rightCols(kLast) *= 1e-4F;
  const Eigen::MatrixXd last = 1e4 * found(gradedFactors(U, mixed, kLast, 1e4F)).rightCols(kLast);
  EXPECT_LT((last - expected.rightCols(kLast)).norm(), 5e-5 * expected.rightCols(kLast).norm());
}

TEST(GradedFactors, OfNothingAreEmptyAndWhatIsNotFiniteIsNotHidden) {
  const RowMatrixXf U = randomMatrix(2, 20, 6);
  RowMatrixXf V = randomMatrix(2, 30, 7);
  EXPECT_EQ(gradedFactors(U.topRows(0), V.topRows(0), 10, 1).U.rowCount(), 0);
  const RowMatrixXf zero = RowMatrixXf::Zero(2, 30);
  EXPECT_EQ(columnsOf(gradedFactors(U, zero, 10, 1).V1, 0, 20).norm(), 0);
  V(1, 4) = std::nanf("");
  EXPECT_FALSE(columnsOf(gradedFactors(U, V, 10, 1).V1, 0, 20).allFinite());
}

}  // namespace
}  // namespace palpa::bem
