#include "bem/linalg/capacitance_matrix.h"

#include <gtest/gtest.h>

#include <random>

#include "bem/base/error.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Well conditioned unsymmetric matrix from which the tests take rows and columns.
MatrixXd testMatrix(Index size) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  MatrixXd matrix(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j) matrix(i, j) = normal(random) + (i == j ? 40.0 : 0.0);
  return matrix;
}

TEST(CapacitanceMatrix, RandomAddingAndRemovingEqualsAFreshSolve) {
  const MatrixXd full = testMatrix(90);
  CapacitanceMatrix capacitance;
  std::vector<Index> members;  // rows of `full`, three at a time
  std::mt19937 random(3);
  for (int step = 0; step < 400; ++step) {
    const bool join = members.empty() || (members.size() < 60 && random() % 2 == 0);
    if (join) {
      std::vector<Index> fresh;
      for (Index block = random() % 30; fresh.empty(); block = (block + 1) % 30)
        if (std::find(members.begin(), members.end(), 3 * block) == members.end())
          fresh = {3 * block, 3 * block + 1, 3 * block + 2};
      capacitance.append(full(members, fresh), full(fresh, members), full(fresh, fresh));
      members.insert(members.end(), fresh.begin(), fresh.end());
    } else {
      const auto first = static_cast<Index>(3 * (random() % (members.size() / 3)));
      capacitance.remove(first, 3);
      members.erase(members.begin() + first, members.begin() + first + 3);
    }
    const MatrixXd expected = full(members, members);
    ASSERT_EQ(capacitance.matrix(), expected);
    const VectorXd right = VectorXd::LinSpaced(expected.rows(), -1, 2);
    const VectorXd direct = expected.partialPivLu().solve(right);
    ASSERT_LE((capacitance.solve(right) - direct).norm(), 1e-12 * (1 + direct.norm()));
  }
}

TEST(CapacitanceMatrix, RefusesADependentRowAndKeepsWorking) {
  const MatrixXd full = testMatrix(6);
  CapacitanceMatrix capacitance;
  const std::vector<Index> first{0, 1, 2};
  capacitance.append(MatrixXd(0, 3), MatrixXd(3, 0), full(first, first));
  // The same place again: identical rows and columns.
  EXPECT_THROW(capacitance.append(full(first, first), full(first, first), full(first, first)),
               SolverError);
  EXPECT_EQ(capacitance.size(), 3);
  const VectorXd right = VectorXd::Ones(3);
  EXPECT_LE((full(first, first) * capacitance.solve(right) - right).norm(), 1e-12);
}

}  // namespace
}  // namespace palpa::bem
