#include <gtest/gtest.h>

#include <random>

#include "bem/linalg/dense_elimination.h"

namespace palpa::bem {
namespace {

TEST(DenseElimination, SolvesSystemsOfAllSizes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int size = 1; size <= 70; ++size) {
    Eigen::MatrixXd room = Eigen::MatrixXd::Zero(size + 5, size + 9);  // part of a larger matrix
    auto system = room.topLeftCorner(size, size + 1);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j <= size; ++j) system(i, j) = number(random);
    system(0, 0) = 0;  // requires pivoting
    if (size == 1) system(0, 0) = 2;
    const Eigen::MatrixXd a = system.leftCols(size);
    const Eigen::VectorXd b = system.col(size);
    solveByElimination(system);
    const Eigen::VectorXd x = system.col(size);
    EXPECT_LE((a * x - b).norm(), 1e-11 * a.norm() * x.norm());
    EXPECT_EQ(room.rightCols(8).norm(), 0);
    EXPECT_EQ(room.bottomRows(5).norm(), 0);
  }
}

TEST(DenseElimination, ReportsASingularSystem) {
  Eigen::MatrixXd system(2, 3);
  system << 1, 2, 1, 2, 4, 3;
  solveByElimination(system);
  EXPECT_FALSE(system.col(2).allFinite());
}

}  // namespace
}  // namespace palpa::bem
