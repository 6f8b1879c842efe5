// Products of rows of packed blocks, with each instruction set.
#include "bem/compressed/block_products.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "bem/compressed/block_rows.h"

namespace palpa::bem {
namespace {

using RowMatrixXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMatrixXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kColumns = 40;

/// A row of blocks in some of the columns, one of them twice, and the last ones.
template <class Block>
class RandomRow {
 public:
  RandomRow() {
    for (int column = 0; column < kColumns; column += 3) add(column, 1);
    add(3, 1);
    add(kColumns - 3, 3);
  }

  /// A x in double precision.
  RowMatrixXd product(const RowMatrixXf& x) const {
    RowMatrixXd sum = RowMatrixXd::Zero(3, x.cols());
    std::size_t b = 0;
    for (const ColumnRun& run : runs_)
      for (int k = 0; k < run.count; ++k) {
        const BlockNumbers numbers = numbersOf(blocks_[b++]);
        const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> block(numbers.data());
        sum += block.cast<double>() * x.middleRows<3>(3 * (run.first + k)).cast<double>();
      }
    return sum;
  }

  BlockProductTask<Block> task(const RowMatrixXf& x, const char* isLoaded, RowMatrixXf& y) const {
    return {blocks_.data(), runs_.data(), runs_.size(), x.data(), x.cols(), isLoaded, y.data()};
  }

 private:
  void add(int column, int count) {
    for (int k = 0; k < count; ++k) {
      BlockNumbers numbers;
      for (float& number : numbers) number = uniform_(generator_);
      if constexpr (std::is_same_v<Block, PackedBlock>)
        blocks_.push_back(packed(numbers));
      else
        blocks_.push_back(packedSymmetric(numbers));
    }
    runs_.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint8_t>(count)});
  }

  std::mt19937 generator_{3};
  std::uniform_real_distribution<float> uniform_{-2, 2};
  std::vector<Block> blocks_;
  std::vector<ColumnRun> runs_;
};

/// Adds to what y has, and leaves out what is read behind x.
template <class Block>
void expectProductsOf(const AddBlockProduct& addBlockProduct) {
  const RandomRow<Block> row;
  constexpr int kRows = 3 * kColumns;
  for (const int width : {1, 2, 3, 4, 5, 15, 16, 17, 20, 32, 35}) {
    RowMatrixXf x(kRows + kReadBehind, width);
    x.setRandom();
    x.bottomRows<kReadBehind>().setConstant(1e9F);
    RowMatrixXf y = RowMatrixXf::Constant(3, width, 0.5F);
    addBlockProduct(row.task(x, nullptr, y));
    const RowMatrixXd expected = row.product(x).array() + 0.5;
    EXPECT_LT((y.cast<double>() - expected).cwiseAbs().maxCoeff(), 2e-5) << width;

    // Columns without load are not read.
    std::vector<char> isLoaded(kColumns, 0);
    isLoaded[3] = isLoaded[kColumns - 1] = 1;
    RowMatrixXf loaded = RowMatrixXf::Zero(x.rows(), width);
    for (const int column : {3, kColumns - 1})
      loaded.middleRows<3>(3 * column) = x.middleRows<3>(3 * column);
    const RowMatrixXd few = row.product(loaded);
    for (int column = 0; column < kColumns; ++column)
      if (!isLoaded[column])
        loaded.middleRows<3>(3 * column).setConstant(std::numeric_limits<float>::quiet_NaN());
    y.setZero();
    addBlockProduct(row.task(loaded, isLoaded.data(), y));
    EXPECT_LT((y.cast<double>() - few).cwiseAbs().maxCoeff(), 2e-5) << width;
  }
}

void expectProducts(const AddBlockProduct& addBlockProduct) {
  expectProductsOf<PackedBlock>(addBlockProduct);
  expectProductsOf<PackedSymmetricBlock>(addBlockProduct);
}

TEST(BlockProducts, OfTheSelectedAndOfTheBaselineSet) {
  expectProducts({addBlockProductBaseline, addBlockProductBaseline});
  expectProducts(addBlockProductForThisProcessor());
}

#ifdef __x86_64__
TEST(BlockProducts, OfAvx2) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "this processor has no AVX2";
  expectProducts({addBlockProductAvx2, addBlockProductAvx2});
}

TEST(BlockProducts, OfAvx512) {
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
      !__builtin_cpu_supports("avx512bw") || !__builtin_cpu_supports("avx512cd"))
    GTEST_SKIP() << "this processor has no AVX-512";
  expectProducts({addBlockProductAvx512, addBlockProductAvx512});
}
#endif

}  // namespace
}  // namespace palpa::bem
