// Products of rows of packed blocks, with each instruction set.
#include "bem/compressed/block_products.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

#include "bem/compressed/block_rows.h"

namespace palpa::bem {
namespace {

using RowMatrixXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMatrixXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A row of blocks in some of 40 columns, one of them twice, and the last one.
class RandomRow {
 public:
  static constexpr int kColumns = 40;

  RandomRow() {
    for (int column = 0; column < kColumns; column += 3) add(column);
    add(3);
    add(kColumns - 1);
  }

  /// A x in double precision.
  RowMatrixXd product(const RowMatrixXf& x) const {
    RowMatrixXd sum = RowMatrixXd::Zero(3, x.cols());
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const BlockNumbers numbers = numbersOf(blocks_[b]);
      const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> block(numbers.data());
      sum += block.cast<double>() * x.middleRows<3>(3 * columns_[b]).cast<double>();
    }
    return sum;
  }

  BlockProductTask task(const RowMatrixXf& x, const char* isLoaded, RowMatrixXf& y) const {
    return {blocks_.data(), columns_.data(), blocks_.size(), x.data(),
            x.cols(),       isLoaded,        y.data()};
  }

 private:
  void add(int column) {
    BlockNumbers numbers;
    for (float& number : numbers) number = uniform_(generator_);
    blocks_.push_back(packed(numbers));
    columns_.push_back(column);
  }

  std::mt19937 generator_{3};
  std::uniform_real_distribution<float> uniform_{-2, 2};
  std::vector<PackedBlock> blocks_;
  std::vector<int> columns_;
};

/// Adds to what y has, and leaves out what is read behind x.
void expectProducts(AddBlockProduct addBlockProduct) {
  const RandomRow row;
  constexpr int kRows = 3 * RandomRow::kColumns;
  for (const int width : {1, 2, 3, 4, 5, 15, 16, 17, 20, 32, 35}) {
    RowMatrixXf x(kRows + BlockProductTask::kRead, width);
    x.setRandom();
    x.bottomRows<BlockProductTask::kRead>().setConstant(1e9F);
    RowMatrixXf y = RowMatrixXf::Constant(3, width, 0.5F);
    addBlockProduct(row.task(x, nullptr, y));
    const RowMatrixXd expected = row.product(x).array() + 0.5;
    EXPECT_LT((y.cast<double>() - expected).cwiseAbs().maxCoeff(), 2e-5) << width;

    // Columns without load are not read.
    std::vector<char> isLoaded(RandomRow::kColumns, 0);
    isLoaded[3] = isLoaded[RandomRow::kColumns - 1] = 1;
    RowMatrixXf loaded = RowMatrixXf::Zero(x.rows(), width);
    for (const int column : {3, RandomRow::kColumns - 1})
      loaded.middleRows<3>(3 * column) = x.middleRows<3>(3 * column);
    const RowMatrixXd few = row.product(loaded);
    for (int column = 0; column < RandomRow::kColumns; ++column)
      if (!isLoaded[column])
        loaded.middleRows<3>(3 * column).setConstant(std::numeric_limits<float>::quiet_NaN());
    y.setZero();
    addBlockProduct(row.task(loaded, isLoaded.data(), y));
    EXPECT_LT((y.cast<double>() - few).cwiseAbs().maxCoeff(), 2e-5) << width;
  }
}

TEST(BlockProducts, OfTheSelectedAndOfTheBaselineSet) {
  expectProducts(addBlockProductBaseline);
  expectProducts(addBlockProductForThisProcessor());
}

#ifdef __x86_64__
TEST(BlockProducts, OfAvx2) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "this processor has no AVX2";
  expectProducts(addBlockProductAvx2);
}

TEST(BlockProducts, OfAvx512) {
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
      !__builtin_cpu_supports("avx512bw") || !__builtin_cpu_supports("avx512cd"))
    GTEST_SKIP() << "this processor has no AVX-512";
  expectProducts(addBlockProductAvx512);
}
#endif

}  // namespace
}  // namespace palpa::bem
