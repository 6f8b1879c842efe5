// Matrices with rows of falling importance, and products of narrow matrices packed as such.
#include "bem/linalg/graded_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "base/byte_reader.h"
#include "bem/compressed/cluster_basis.h"
#include "bem/compressed/falling_factors.h"

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

/// Numbers of the same size in all rows, of which a few combinations are large.
RowMatrixXf fallingRows(Index rows, Index columns, unsigned seed) {
  RowMatrixXf mixing = randomMatrix(rows, rows, seed);
  mixing.diagonal().array() += 5;
  RowMatrixXf falling = randomMatrix(rows, columns, seed + 1);
  for (Index r = 0; r < rows; ++r) falling.row(r) *= std::pow(2.0F, -0.7F * static_cast<float>(r));
  return mixing * falling;
}

/// Rows as they are stored.
Eigen::MatrixXd stored(const RowMatrixXf& rows, std::span<const Bits> bits) {
  return columnsOf(GradedRows(rows, bits), 0, static_cast<int>(rows.cols())).cast<double>();
}

TEST(FallingFactors, TakeLessMemoryAndKeepTheProduct) {
  constexpr Index kSummands = 24, kHeight = 200, kWidth = 300, kLast = 101;
  const RowMatrixXf V = fallingRows(kSummands, kWidth, 3), U = randomMatrix(kSummands, kHeight, 5);
  const Eigen::MatrixXd expected = U.cast<double>().transpose() * V.cast<double>();
  const auto found = [&](const FallingFactors& some) {
    Eigen::MatrixXd factor(some.V.rows(), kWidth);
    factor << stored(some.V.leftCols(kWidth - kLast), some.bitsOfV),
        stored(some.V.rightCols(kLast), some.bitsOfV);
    return Eigen::MatrixXd(stored(some.U, some.bitsOfU).transpose() * factor);
  };
  const FallingFactors factors = fallingFactors(U, V, kLast, 1);
  EXPECT_LT((found(factors) - expected).norm(), 5e-5 * expected.norm());
  const auto bytes = GradedRows(factors.U, factors.bitsOfU).bytes() +
                     GradedRows(factors.V, factors.bitsOfV).bytes();
  EXPECT_LT(static_cast<double>(bytes), 2.2 * kSummands * (kHeight + kWidth));

  // Columns of small numbers that matter as much as the others are as exact.
  RowMatrixXf mixed = V;
  mixed.rightCols(kLast) *= 1e-4F;
  const Eigen::MatrixXd last = 1e4 * found(fallingFactors(U, mixed, kLast, 1e4F)).rightCols(kLast);
  EXPECT_LT((last - expected.rightCols(kLast)).norm(), 5e-5 * expected.rightCols(kLast).norm());
}

TEST(FallingFactors, OfNothingAreEmptyAndWhatIsNotFiniteIsNotHidden) {
  const RowMatrixXf U = randomMatrix(2, 20, 6);
  RowMatrixXf V = randomMatrix(2, 30, 7);
  EXPECT_EQ(fallingFactors(U.topRows(0), V.topRows(0), 10, 1).U.rows(), 0);
  const RowMatrixXf zero = RowMatrixXf::Zero(2, 30);
  EXPECT_EQ(fallingFactors(U, zero, 10, 1).V.norm(), 0);
  V(1, 4) = std::nanf("");
  EXPECT_FALSE(fallingFactors(U, V, 10, 1).V.allFinite());
}

/// Factors of blocks at several distances, whose rows are combinations of the same ones.
struct FactorsOfACluster {
  static constexpr Index kWidth = 300, kLast = 101;
  /// The numbers of the last columns are smaller by `lastFactor`.
  explicit FactorsOfACluster(float lastFactor) {
    RowMatrixXf common = fallingRows(24, kWidth, 8);
    common.rightCols(kLast) *= lastFactor;
    for (int k = 0; k < 9; ++k) {
      const RowMatrixXf V = std::pow(0.3F, static_cast<float>(k)) *
                            (randomMatrix(20, 24, static_cast<unsigned>(20 + k)) * common);
      FallingFactors falling = fallingFactors(randomMatrix(20, 50, static_cast<unsigned>(40 + k)),
                                              V, kLast, 1 / lastFactor);
      factors.push_back({falling.V, falling.bitsOfV});
    }
    for (const RightFactor& factor : factors) list.push_back(&factor);
  }
  std::vector<RightFactor> factors;
  std::vector<const RightFactor*> list;
};

TEST(ClusterBasis, TakesLessMemoryAndKeepsEachFactor) {
  for (const float lastFactor : {1.0F, 1e-4F}) {
    const FactorsOfACluster of(lastFactor);
    constexpr int kFirst = static_cast<int>(of.kWidth - of.kLast),
                  kLast = static_cast<int>(of.kLast);
    const auto combined = combineFactors(of.list, kLast, 1 / lastFactor, 1);
    ASSERT_TRUE(combined);
    EXPECT_LE(combined->basis.size(), 24);
    std::size_t before = 0, after = combined->basis.bytes();
    Eigen::MatrixXd basis(combined->basis.size(), of.kWidth);
    basis << columnsOf(combined->basis.ofNodes, 0, kFirst).cast<double>(),
        columnsOf(combined->basis.ofSlots, 0, kLast).cast<double>();
    for (std::size_t k = 0; k < of.factors.size(); ++k) {
      const RightFactor& factor = of.factors[k];
      before += GradedRows(factor.V, factor.bits).bytes();
      after += combined->coefficients[k].bytes();
      // Each row within a part of the largest one, as rounding leaves it, also the small last
      // columns.
      const Eigen::MatrixXd difference =
          columnsOf(combined->coefficients[k], 0, combined->basis.size()).cast<double>() * basis -
          factor.V.cast<double>();
      const auto largest = [&](const auto& rows) { return rows.rowwise().norm().maxCoeff(); };
      const Eigen::MatrixXd expected = factor.V.cast<double>();
      EXPECT_LT(largest(difference.leftCols(kFirst)), 1e-5 * largest(expected.leftCols(kFirst)))
          << k;
      EXPECT_LT(largest(difference.rightCols(kLast)), 1e-5 * largest(expected.rightCols(kLast)))
          << k;
    }
    EXPECT_LT(after, before / 2);
  }
}

TEST(ClusterBasis, IsNotMadeOfUnrelatedFactorsNorOfWhatIsNotFinite) {
  std::vector<RightFactor> unrelated;
  std::vector<const RightFactor*> list;
  for (unsigned k = 0; k < 5; ++k)
    unrelated.push_back({randomMatrix(20, 300, k), std::vector<Bits>(20, Bits::k24)});
  for (const RightFactor& factor : unrelated) list.push_back(&factor);
  EXPECT_FALSE(combineFactors(list, 100, 1, 1));
  EXPECT_FALSE(combineFactors({}, 100, 1, 1));
  FactorsOfACluster of(1);
  ASSERT_TRUE(combineFactors(of.list, of.kLast, 1, 1));
  of.factors[3].V(0, 7) = std::nanf("");
  EXPECT_FALSE(combineFactors(of.list, of.kLast, 1, 1));
}

}  // namespace
}  // namespace palpa::bem
