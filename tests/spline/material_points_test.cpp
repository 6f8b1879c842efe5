#include <gtest/gtest.h>

#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "bem/gradient/surface_rules.h"
#include "spline_body.h"
#include "tests/quadratic/quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// A random density over sampled points.
ShapeDensity randomDensity(int points, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  ShapeDensity density(points);
  for (double& value : density.value.reshaped()) value = number(random);
  for (double& value : density.slope.reshaped()) value = number(random);
  return density;
}

/// Elements follow a linear motion of their material points, so that the derivative by the points
/// must be the density's own along this motion. `points`: the material points, mm.
void expectLinearMotion(const MovingElements& moving, const SampledElements& sampled,
                        const std::vector<Vector3d>& points) {
  std::mt19937 random(1);
  const ShapeDensity density = randomDensity(static_cast<int>(sampled.places.size()), random);
  const Matrix3Xd byPoints = byMaterialPoints(moving, sampled, density);
  ASSERT_EQ(byPoints.cols(), static_cast<Eigen::Index>(points.size()));
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 3; ++trial) {
    Matrix3d slope;
    for (double& value : slope.reshaped()) value = number(random);
    const Vector3d shift(number(random), number(random), number(random));
    Matrix3Xd motion(3, density.value.cols()), slopes(3, density.slope.cols());
    Eigen::Index q = 0;
    for (const FieldSampler::Block& block : sampled.blocks)
      for (const SampledPoint& point : block.points) {
        motion.col(q) = slope * point.position + shift;
        slopes.middleCols<2>(2 * q) = slope * point.frame.leftCols<2>();
        ++q;
      }
    double found = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
      found += byPoints.col(static_cast<Eigen::Index>(k)).dot(slope * points[k] + shift);
    const double expected = density.along(motion, slopes);
    EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected)) << trial;
  }
}

/// Places of the material points of splines, mm: means over the elements that share them.
std::vector<Vector3d> placesOf(const MovingSplines& moving, int elements) {
  Matrix3Xd sum = Matrix3Xd::Zero(3, moving.pointCount()), count = sum;
  for (int e = 0; e < elements; ++e) {
    const Matrix3Xd positions = moving.positions(e);
    moving.addTo(e, positions, sum);
    moving.addTo(e, Matrix3Xd::Ones(3, positions.cols()), count);
  }
  std::vector<Vector3d> places;
  for (int k = 0; k < moving.pointCount(); ++k)
    places.emplace_back(sum.col(k).cwiseQuotient(count.col(k)));
  return places;
}

TEST(MaterialPoints, SplinesFollowALinearMotion) {
  const auto on = discretised(modeling::makeSphere(10), 5, [](const Vector3d&) { return 0; });
  const MovingSplines moving(on->surface());
  const std::vector<Vector3d> points = placesOf(moving, on->surface().elementCount());
  expectLinearMotion(moving,
                     sampledSplines(on->surface(), on->elements(), allElements(on->elements()), 3),
                     points);
}

TEST(MaterialPoints, QuadraticTrianglesFollowALinearMotion) {
  const auto on = quadratic(verification::sphereMesh(10, 2), onSphere(10));
  expectLinearMotion(MovingTriangles(on->surface()),
                     sampledTriangles(on->surface(), allElements(on->surface()), 1), on->places());
}

}  // namespace
}  // namespace palpa::bem::test
