#include "bem/spline/surface_part.h"

#include <numbers>

#include "bem/spline/spline_collocation.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

double areaWithTag(const SplineSurface& surface, int tag) {
  std::vector<int> list;
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.elements()[e].tag == tag) list.push_back(e);
  double area = 0;
  visitSplinePoints(surface, list, 8, INFINITY,
                    [&](const ElementPlace&, const SurfaceJet&, double weight) { area += weight; });
  return area;
}

TEST(CutMap, RunsBetweenItsGraphsAndBack) {
  CutMap::Values lower{}, upper{};
  for (int k = 0; k < CutMap::kPoints; ++k) {
    lower[k] = 0.1 * std::sin(CutMap::node(k));
    upper[k] = 1 + 0.2 * CutMap::node(k) * CutMap::node(k);
  }
  for (const int axis : {0, 1}) {
    const CutMap map(axis, 2, 5, lower, upper);
    for (const double s : {0.0, 0.3, 1.0})
      for (const double t : {0.0, 0.6, 1.0}) {
        const CutMap::Image image = map.at(s, t);
        EXPECT_GT(image.derivative.determinant(), 0);
        const double step = 1e-6;
        const Eigen::Vector2d byS =
            (map.at(s + step, t).parameters - map.at(s - step, t).parameters) / (2 * step);
        const Eigen::Vector2d byT =
            (map.at(s, t + step).parameters - map.at(s, t - step).parameters) / (2 * step);
        EXPECT_LT((byS - image.derivative.col(0)).norm(), 1e-8);
        EXPECT_LT((byT - image.derivative.col(1)).norm(), 1e-8);
        const auto back = map.invert(image.parameters[0], image.parameters[1], 1e-9);
        ASSERT_TRUE(back);
        EXPECT_LT((*back - Eigen::Vector2d(s, t)).norm(), 1e-12);
      }
    EXPECT_FALSE(axis == 0 ? map.invert(3, -0.2, 1e-9) : map.invert(-0.2, 3, 1e-9));
    EXPECT_FALSE(axis == 0 ? map.invert(1.9, 0.5, 1e-9) : map.invert(0.5, 1.9, 1e-9));
  }
}

/// Areas of caps of a sphere, 2 pi R h, from a border inside of one patch to one that crosses the
/// corners of patches. What is left is the fit of the sphere, 1e-5 of its area.
TEST(SurfacePart, CutsCapsOfTheRightSize) {
  const SplineSurface sphere = app::splineSurfaceOf(modeling::makeSphere(25, 9));
  const Vector3d tilted = Vector3d(0.3, -0.5, 1).normalized();
  for (const Vector3d& axis : {Vector3d(0, 0, 1), tilted})
    for (const double height : {1.0, 5.0, 12.0, 20.0, 24.3, 31.0, 43.0}) {
      const SplineSurface cut = withPart(
          sphere, [&](const Vector3d& x) { return x.dot(axis) + 25 - height; }, 1);
      const double exact = 2 * std::numbers::pi * 25 * height;
      EXPECT_NEAR(areaWithTag(cut, 1), exact, 2e-3 * exact) << height;
      EXPECT_NEAR(areaWithTag(cut, 0) + areaWithTag(cut, 1), 4 * std::numbers::pi * 25 * 25, 0.5);
    }
}

TEST(SurfacePart, TearsFunctionsOnlyAtTheBorder) {
  const SplineSurface sphere = app::splineSurfaceOf(modeling::makeSphere(25, 9));
  const SplineSurface cut = withPart(
      sphere, [](const Vector3d& x) { return x.z() + 20; }, 1);
  EXPECT_GT(cut.coefficientCount(), sphere.coefficientCount());
  EXPECT_LT(cut.coefficientCount(), 1.3 * sphere.coefficientCount());
  const auto points = grevilleCollocation(cut);
  for (int k = 0; k < cut.coefficientCount(); ++k) {
    EXPECT_LT(cut.tornFrom(k), sphere.coefficientCount());
    if (cut.tornFrom(k) != k) {
      EXPECT_LT(points[k].position.z(), -20 + 1e-9) << "its own side";
    } else if (cut.isTorn(k)) {
      EXPECT_GT(points[k].position.z(), -20 - 1e-9) << "its own side";
    }
    for (const ElementPlace& place : points[k].places)
      EXPECT_LT((cut.evaluate(place).position - points[k].position).norm(), 1e-8);
  }
  // Nothing is cut where the border runs along edges of patches.
  const SplineSurface box = app::splineSurfaceOf(modeling::makeBox({40, 30, 20}));
  const SplineSurface fixed = withPart(
      box, [](const Vector3d& x) { return x.z() - 1e-6; }, 1);
  EXPECT_EQ(fixed.coefficientCount(), box.coefficientCount());
  EXPECT_NEAR(areaWithTag(fixed, 1), 1200, 1e-9) << "the base alone";
}

/// With exact data on both sides, tearing does no harm: the border is free to be anywhere.
TEST(SurfacePart, KeepsTheAccuracyOfASmoothField) {
  const Material material{0.1, 0.3};
  const ExactField exact = kelvinField({20, 15, 40}, {0.03, -0.02, 0.06}, material);
  const SplineSurface sphere = app::splineSurfaceOf(modeling::makeSphere(25, 9));
  for (const double level : {-20.0, -11.0}) {
    const SplineBody body(withPart(
                              sphere, [&](const Vector3d& x) { return x.z() - level; }, 1),
                          material, exact, {1e-5});
    const double error = body.displacementError(exact);
    std::printf("fixed below %g: n %d, error of u %.2e\n", level, body.surface.coefficientCount(),
                error);
    EXPECT_LT(error, 6e-4);  // 3.1e-4 with a whole patch fixed
  }
}

}  // namespace
}  // namespace palpa::bem::test
