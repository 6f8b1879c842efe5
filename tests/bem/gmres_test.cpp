#include "bem/linalg/gmres.h"

#include <gtest/gtest.h>

#include "bem/base/error.h"

namespace palpa::bem {
namespace {

using Eigen::MatrixXd;

TEST(Gmres, SolvesEveryColumnToItsTolerance) {
  std::srand(1);
  const MatrixXd A = MatrixXd::Identity(80, 80) + 0.03 * MatrixXd::Random(80, 80);
  MatrixXd b = MatrixXd::Random(80, 5);
  b.col(1) *= 1e-9;
  b.col(3).setZero();
  const GmresSolution solution =
      gmres([&](const MatrixXd& v) { return MatrixXd(A * v); }, b, 1e-11, 80, {});
  const MatrixXd exact = A.lu().solve(b);
  for (int c = 0; c < b.cols(); ++c)
    EXPECT_LE((solution.x.col(c) - exact.col(c)).norm(), 1e-10 * exact.col(c).norm()) << c;
  EXPECT_LE(solution.residual, 1e-11);
  EXPECT_LT(solution.steps, 30);
}

/// In exact arithmetic the number of steps is the rank of the change of the identity plus one.
TEST(Gmres, NeedsFewStepsForAChangeOfLowRank) {
  std::srand(2);
  const MatrixXd A =
      MatrixXd::Identity(200, 200) + MatrixXd::Random(200, 3) * MatrixXd::Random(3, 200);
  const GmresSolution solution = gmres([&](const MatrixXd& v) { return MatrixXd(A * v); },
                                       MatrixXd::Random(200, 4), 1e-9, 50, {});
  EXPECT_LE(solution.steps, 4);
  EXPECT_LE(solution.residual, 1e-9);
}

TEST(Gmres, ReportsTheResidualReached) {
  // A cyclic shift does not reduce the residual until the last step.
  const auto shift = [](const MatrixXd& v) {
    MatrixXd moved(v.rows(), v.cols());
    for (Eigen::Index k = 0; k < v.rows(); ++k) moved.row((k + 1) % v.rows()) = v.row(k);
    return moved;
  };
  const MatrixXd b = MatrixXd::Identity(20, 1);
  EXPECT_NEAR(gmres(shift, b, 1e-9, 10, {}).residual, 1, 1e-12);
  EXPECT_LE(gmres(shift, b, 1e-9, 20, {}).residual, 1e-9);
}

TEST(Gmres, Stops) {
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  const auto apply = [&](const MatrixXd& v) {
    stop.request_stop();
    return MatrixXd(2 * v + MatrixXd::Ones(v.rows(), 1) * v.colwise().sum());
  };
  EXPECT_THROW(gmres(apply, MatrixXd::Random(30, 1), 1e-12, 30, job), Cancelled);
}

}  // namespace
}  // namespace palpa::bem
