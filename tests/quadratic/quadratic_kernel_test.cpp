#include "bem/quadratic/quadratic_kernel.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bem/base/instruction_set.h"
#include "bem/quadratic/quadratic_surface.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

std::vector<QuadraticKernel> variants() {
  std::vector<QuadraticKernel> all{{placeOnTriangleBaseline, triangleBasisBaseline}};
#if defined(__x86_64__)
  if (instructionSet() != InstructionSet::kBaseline)
    all.push_back({placeOnTriangleAvx2, triangleBasisAvx2});
  if (instructionSet() == InstructionSet::kAvx512)
    all.push_back({placeOnTriangleAvx512, triangleBasisAvx512});
#endif
  return all;
}

std::vector<double> randomNumbers(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(any(random));
  return values;
}

TEST(QuadraticKernel, TheBasisIsQuadraticBasis) {
  std::mt19937 random(1);
  constexpr int kPoints = 11;
  const std::vector<double> u = randomNumbers(kPoints, random), v = randomNumbers(kPoints, random);
  for (const QuadraticKernel& kernel : variants()) {
    std::vector<double> found(static_cast<std::size_t>(kPoints) * kElementLanes, NAN);
    kernel.basis({kPoints, u.data(), v.data(), found.data()});
    for (int p = 0; p < kPoints; ++p) {
      const QuadraticBasis expected(u[p], v[p]);
      for (int f = 0; f < kElementLanes; ++f)
        EXPECT_NEAR(found[p * kElementLanes + f], f < 6 ? expected.values[f] : 0, 1e-14)
            << p << ' ' << f;
    }
  }
}

TEST(QuadraticKernel, PointsLieOnThePolynomial) {
  std::mt19937 random(2);
  constexpr int kPoints = 3 * kElementLanes;
  const std::vector<double> u = randomNumbers(kPoints, random), v = randomNumbers(kPoints, random),
                            weight = randomNumbers(kPoints, random),
                            coefficients = randomNumbers(18, random);
  const Eigen::Map<const Eigen::Matrix<double, 3, 6>> c(coefficients.data());
  for (const QuadraticKernel& kernel : variants()) {
    std::vector<double> geometry(static_cast<std::size_t>(kPointValues) * kPoints, NAN);
    kernel.place(
        {coefficients.data(), kPoints, u.data(), v.data(), weight.data(), geometry.data()});
    const Eigen::Map<const Eigen::MatrixXd> found(geometry.data(), kPoints, kPointValues);
    for (int p = 0; p < kPoints; ++p) {
      const double a = u[p], b = v[p];
      const Vector3d position = c * Eigen::Vector<double, 6>(1, a, b, a * a, a * b, b * b),
                     du = c * Eigen::Vector<double, 6>(0, 1, 0, 2 * a, b, 0),
                     dv = c * Eigen::Vector<double, 6>(0, 0, 1, 0, a, 2 * b),
                     area = weight[p] * du.cross(dv);
      EXPECT_LT((found.row(p).head<3>().transpose() - position).norm(), 1e-14) << p;
      EXPECT_LT((found.row(p).segment<3>(3).transpose() - area).norm(), 1e-13) << p;
      EXPECT_NEAR(found(p, 6), area.norm(), 1e-13) << p;
    }
  }
}

}  // namespace
}  // namespace palpa::bem::test
