#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "bem/base/error.h"
#include "bem/compressed/tile_difference.h"
#include "bem/compressed/tile_lu.h"
#include "bem/linalg/row_choice.h"

namespace palpa::bem::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;

TEST(RowChoice, InterpolatesAllRowsDespiteZeroBlocks) {
  // Two groups of rows without a common column, as of components of fields on flat faces.
  srand(3);
  RowMatrixXf A = RowMatrixXf::Zero(60, 50);
  A.topLeftCorner(30, 25) = MatrixXf::Random(30, 4) * MatrixXf::Random(4, 25);
  A.bottomRightCorner(30, 25) = 0.1F * MatrixXf::Random(30, 3) * MatrixXf::Random(3, 25);
  const RowChoice choice = chooseRows(A, 1e-4F);
  EXPECT_EQ(choice.rows.size(), 7);
  const MatrixXf chosen = A(choice.rows, Eigen::all);
  EXPECT_LT((choice.weights * chosen - A).norm(), 1e-5F * A.norm());
}

/// Turns a dense tile into a product of the given rank.
void makeNarrow(LowRankTile& tile, int rank) {
  const Eigen::BDCSVD<MatrixXf> svd(tile.X, Eigen::ComputeThinU | Eigen::ComputeThinV);
  tile.X = svd.matrixU().leftCols(rank) * svd.singularValues().head(rank).asDiagonal();
  tile.Y = svd.matrixV().leftCols(rank);
}

/// A tile of random numbers, its norm about 1; rank 0: dense.
LowRankTile randomTile(Index rows, Index columns, Index rank) {
  const auto size = static_cast<float>(rows * columns);
  if (rank == 0) return {MatrixXf::Random(rows, columns) / std::sqrt(size), {}};
  return {MatrixXf::Random(rows, rank), MatrixXf::Random(columns, rank) / std::sqrt(size)};
}

TEST(TileDifference, IsNarrowOrDense) {
  // Products of all kinds of factors.
  srand(5);
  constexpr Index kRows = 150, kColumns = 170, kInner = 120;
  for (const Index baseRank : {0, 4})
    for (const Index leftRank : {0, 3, 70})
      for (const Index rightRank : {0, 2, 75}) {
        SCOPED_TRACE(testing::Message() << baseRank << " " << leftRank << " " << rightRank);
        const LowRankTile base = randomTile(kRows, kColumns, baseRank);
        std::vector<LowRankTile> left{
            randomTile(kRows, kInner, leftRank), {}, randomTile(kRows, kInner, 2)};
        SharedFactors right;
        right.factors = {
            randomTile(kInner, kColumns, rightRank), randomTile(kInner, kColumns, 1), {}};
        right.draw(kColumns, 9);
        const MatrixXf expected =
            toDense(base) - toDense(left.front()) * toDense(right.factors.front());
        const LowRankTile made = TileDifference(base, left, right, {}).compress(1e-4F, 11);
        EXPECT_LT((toDense(made) - expected).norm(), 1e-4F);
        // Bases of at most 50 columns.
        const bool isNarrow =
            baseRank > 0 && ((leftRank > 0 && leftRank < 50) || (rightRank > 0 && rightRank < 50));
        EXPECT_EQ(made.isDense(), !isNarrow);
        if (isNarrow) {
          EXPECT_LE(made.X.cols(), 7);
        }
      }
}

TEST(TileLu, SolvesWithItsMatrixAndTheTransposed) {
  // Points on a line: tiles off the diagonal are smooth and have small ranks.
  constexpr int kTiles = 4, kSize = 250, kAll = kTiles * kSize;
  const auto entry = [](int i, int j) {
    const double distance = (i - j) / 60.0;
    return static_cast<float>((i == j ? 40 : 0) + 1 / (1 + distance * distance) + 0.1 * (i > j));
  };
  MatrixXf A(kAll, kAll);
  for (int j = 0; j < kAll; ++j)
    for (int i = 0; i < kAll; ++i) A(i, j) = entry(i, j);
  const TileLu factors(std::vector<int>(kTiles, kSize), 1e-5F,
                       [&](int row, int column) {
                         LowRankTile tile{A.block(row * kSize, column * kSize, kSize, kSize), {}};
                         if (std::abs(row - column) == 2) makeNarrow(tile, 20);
                         return tile;
                       },
                       {});
  EXPECT_LT(factors.meanRank(), 25);
  EXPECT_GT(factors.meanRank(), 0);
  EXPECT_NEAR(factors.norm1(), A.cwiseAbs().colwise().sum().maxCoeff(), 1e-3 * factors.norm1());
  srand(2);
  const MatrixXf expected = MatrixXf::Random(kAll, 3);
  MatrixXf x = A * expected;
  factors.solveInPlace(x, {});
  EXPECT_LT((x - expected).norm(), 1e-3F * expected.norm());
  x = A.transpose() * expected;
  factors.solveTransposedInPlace(x, {});
  EXPECT_LT((x - expected).norm(), 1e-3F * expected.norm());
}

TEST(TileLu, NamesASingularMatrix) {
  EXPECT_THROW(TileLu({40, 40}, 1e-3F,
                      [](int, int) {
                        return LowRankTile{MatrixXf::Zero(40, 40), {}};
                      },
                      {}),
               SolverError);
}

}  // namespace
}  // namespace palpa::bem::test
