#include "bem/spline/spline_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "bem/base/instruction_set.h"
#include "bem/triangle/kelvin.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

struct Loops : SplineKernel, KelvinSumLoops {};

std::vector<Loops> variants() {
  std::vector<Loops> all{
      {{placePointsBaseline, tabulateBaseline},
       {sumKernelsBaseline, addSumsBaseline, makeBlocksUBaseline, makeBlocksTBaseline}}};
#if defined(__x86_64__)
  if (instructionSet() != InstructionSet::kBaseline)
    all.push_back({{placePointsAvx2, tabulateAvx2},
                   {sumKernelsAvx2, addSumsAvx2, makeBlocksUAvx2, makeBlocksTAvx2}});
  if (instructionSet() == InstructionSet::kAvx512)
    all.push_back({{placePointsAvx512, tabulateAvx512},
                   {sumKernelsAvx512, addSumsAvx2, makeBlocksUAvx512, makeBlocksTAvx512}});
#endif
  return all;
}

/// Points beside the origin with any area vectors and functions.
struct Sample {
  int used, count;
  std::vector<double> geometry;

  Sample(int points, std::mt19937& random) : used(points), count(roundUpToLanes(points)) {
    std::uniform_real_distribution<double> any(-1, 1);
    geometry.resize(static_cast<std::size_t>(kPointValues) * count);
    for (int p = 0; p < count; ++p) {
      const bool isUsed = p < used;
      const Vector3d position(2 + any(random), any(random), any(random));
      const Vector3d area =
          isUsed ? Vector3d(any(random), any(random), any(random)) : Vector3d(Vector3d::Zero());
      for (int c = 0; c < 3; ++c) {
        geometry[c * count + p] = position[c];
        geometry[(3 + c) * count + p] = area[c];
      }
      geometry[6 * count + p] = area.norm();
    }
  }
  Vector3d vector(int first, int p) const {
    return {geometry[first * count + p], geometry[(first + 1) * count + p],
            geometry[(first + 2) * count + p]};
  }
};

/// The sums as spline_kernel.h states them, point by point.
template <class Basis>
std::vector<KernelSums> writtenOut(const Sample& sample, const Vector3d& x, int functions,
                                   const Basis& basis) {
  constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
  std::vector<KernelSums> sums(functions, KernelSums{});
  for (int p = 0; p < sample.used; ++p) {
    const Vector3d r = sample.vector(0, p) - x, area = sample.vector(3, p);
    const double R = r.norm();
    for (int f = 0; f < functions; ++f) {
      const double N = basis(p, f);
      for (int k = 0; k < 6; ++k) {
        const double product = r[kRow[k]] * r[kColumn[k]];
        sums[f].of[k] += N * area.norm() * product / std::pow(R, 3);
        sums[f].of[6 + k] += N * r.dot(area) * product / std::pow(R, 5);
      }
      const Vector3d turn = r.cross(area) / std::pow(R, 3);
      for (int c = 0; c < 3; ++c) sums[f].of[12 + c] += N * turn[c];
    }
  }
  return sums;
}

void expectSame(const std::vector<KernelSums>& found, const std::vector<KernelSums>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t f = 0; f < found.size(); ++f)
    for (int k = 0; k < kKernelSums; ++k)
      EXPECT_NEAR(found[f].of[k], expected[f].of[k], 1e-12) << f << ' ' << k;
}

TEST(SplineKernel, SumsOverTensorRulesAreWhatTheyAreCalled) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const Vector3d x(0.1, -0.2, 0.3);
  for (const Loops& kernel : variants())
    for (int n = 3; n <= kElementLanes; ++n)
      for (const auto& [inU, inV] : {std::pair(2, 6), {3, 3}, {4, 4}, {5, 2}, {6, 5}}) {
        const Sample sample(n * n, random);
        std::vector<double> u(n * inU), v(n * inV);
        for (auto* list : {&u, &v})
          for (double& value : *list) value = any(random);
        std::vector<KernelSums> sums(inU * inV, KernelSums{});
        kernel.sumKernels({x.data(),
                           sample.used,
                           sample.count,
                           sample.geometry.data(),
                           n,
                           {u.data(), v.data()},
                           {inU, inV},
                           roundUpToLanes(inU * inV),
                           sums.data()});
        const int size = inU, sizeV = inV;
        expectSame(sums, writtenOut(sample, x, inU * inV, [&](int p, int f) {
                     return u[p % n * size + f % size] * v[p / n * sizeV + f / size];
                   }));
      }
}

TEST(SplineKernel, SumsOverAnyPointsAreWhatTheyAreCalled) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  const Vector3d x(0.1, -0.2, 0.3);
  for (const Loops& kernel : variants())
    for (const int points : {1, 8, 63, 64, 65, 200})
      for (const int functions : {4, 9, 16, 25}) {
        const Sample sample(points, random);
        const int stride = roundUpToLanes(functions);
        std::vector<double> basis(static_cast<std::size_t>(stride) * sample.count);
        for (double& value : basis) value = any(random);
        std::vector<KernelSums> sums(functions, KernelSums{});
        kernel.sumKernels({x.data(),
                           sample.used,
                           sample.count,
                           sample.geometry.data(),
                           0,
                           {basis.data(), nullptr},
                           {functions, 0},
                           stride,
                           sums.data()});
        expectSame(sums, writtenOut(sample, x, functions,
                                    [&](int p, int f) { return basis[p * stride + f]; }));
      }
}

/// A function that is 1 at one quadrature point and 0 at all others: its blocks are Kelvin's
/// kernels themselves.
TEST(SplineKernel, BlocksAreKelvinsKernels) {
  const Material material{0.7, 0.35};
  const double nu = material.poissonRatio;
  const KelvinConstants constants{1 / (16 * M_PI * material.shear() * (1 - nu)),
                                  -1 / (8 * M_PI * (1 - nu)), 3 - 4 * nu, 1 - 2 * nu};
  constexpr int kCoefficients = 5;
  const std::vector<int> wanted{3, 0, 4};
  std::mt19937 random(4);
  for (const Loops& kernel : variants()) {
    std::vector<double> T[kElementLanes], U[kElementLanes];
    std::vector<Sample> samples;
    MakeBlocksTask ofT{constants, {}, wanted.data(), static_cast<int>(wanted.size()), nullptr};
    MakeBlocksTask ofU = ofT;
    const Vector3d x(0.1, -0.2, 0.3);
    for (int k = 0; k < kElementLanes; ++k) {
      samples.emplace_back(kCoefficients, random);
      const auto sums =
          writtenOut(samples[k], x, kCoefficients, [](int p, int f) { return p == f ? 1.0 : 0.0; });
      for (const KernelSums& sum : sums) {
        U[k].insert(U[k].end(), sum.of, sum.of + kKernelSumsU);
        T[k].insert(T[k].end(), sum.of + kKernelSumsU, sum.of + kKernelSums);
      }
      U[k].resize(U[k].size() + kSumsPadding, NAN);
      T[k].resize(T[k].size() + kSumsPadding, NAN);
      ofU.sums[k] = U[k].data();
      ofT.sums[k] = T[k].data();
    }
    alignas(64) double blocksU[3][9][kElementLanes], blocksT[3][9][kElementLanes];
    ofU.blocks = &blocksU[0][0][0];
    ofT.blocks = &blocksT[0][0][0];
    kernel.makeBlocksU(ofU);
    kernel.makeBlocksT(ofT);
    for (int k = 0; k < kElementLanes; ++k)
      for (int j = 0; j < 3; ++j) {
        const Vector3d y = samples[k].vector(0, wanted[j]), area = samples[k].vector(3, wanted[j]);
        const Eigen::Matrix3d u = area.norm() * kelvinDisplacement(x, y, material),
                              t = area.norm() * kelvinTraction(x, y, area.normalized(), material);
        for (int c = 0; c < 3; ++c)
          for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(blocksU[j][3 * c + i][k], u(i, c), 1e-12);
            EXPECT_NEAR(blocksT[j][3 * c + i][k], t(i, c), 1e-12);
          }
      }
  }
}

TEST(SplineKernel, SumsAreAddedToTheirCoefficients) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const std::vector<int> coefficients{3, 0, 3}, slots{1, 4, 2};  // one of them twice
  std::vector<KernelSums> sums(3);
  for (KernelSums& sum : sums)
    for (double& value : sum.of) value = any(random);
  for (const Loops& kernel : variants()) {
    std::vector<double> T(4 * kKernelSumsT, 1.0), U(5 * kKernelSumsU, 1.0);
    std::vector<double> expectedT = T, expectedU = U;
    for (int f = 0; f < 3; ++f) {
      for (int k = 0; k < kKernelSumsU; ++k)
        expectedU[kKernelSumsU * slots[f] + k] += sums[f].of[k];
      for (int k = 0; k < kKernelSumsT; ++k)
        expectedT[kKernelSumsT * coefficients[f] + k] += sums[f].of[kKernelSumsU + k];
    }
    kernel.addSums({sums.data(), 3, coefficients.data(), slots.data(), T.data(), U.data()});
    EXPECT_EQ(T, expectedT);
    EXPECT_EQ(U, expectedU);
  }
}

TEST(SplineKernel, TabulatedFunctionsAreThoseOfTheBasis) {
  const BsplineBasis basis(3, {0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1});
  const std::vector<double> points{0.31, 0.4, 0.55, 0.6, 0.69};
  for (const Loops& kernel : variants()) {
    std::vector<double> values(4 * points.size());
    kernel.tabulate(
        {basis.polynomials(1), points.data(), static_cast<int>(points.size()), values.data()});
    for (std::size_t p = 0; p < points.size(); ++p) {
      double expected[4], slopes[4];
      basis.evaluate(1, points[p], expected, slopes);
      for (int f = 0; f < 4; ++f) EXPECT_NEAR(values[4 * p + f], expected[f], 1e-14);
    }
  }
}

}  // namespace
}  // namespace palpa::bem::test
