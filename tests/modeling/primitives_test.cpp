#include "modeling/shapes/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

constexpr double kPi = std::numbers::pi;

/// Calls visit(patch, u, v) on a grid over every patch.
template <class Visit>
void forGrid(const Solid& solid, int cells, Visit visit) {
  for (std::size_t p = 0; p < solid.patches().size(); ++p)
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j)
        visit(static_cast<int>(p), static_cast<double>(i) / cells, static_cast<double>(j) / cells);
}

double sphereFitError(int controlPoints) {
  const double radius = 25.0;
  const Solid sphere = makeSphere(radius, controlPoints);
  const SurfaceEvaluator surface(sphere);
  double worst = 0.0;
  forGrid(sphere, 40, [&](int p, double u, double v) {
    worst = std::max(worst, std::abs(surface.position(p, u, v).norm() / radius - 1.0));
  });
  return worst;
}

TEST(Sphere, DeviationIsSmallAndDecreasesWithMorePoints) {
  const double seven = sphereFitError(7);
  EXPECT_LE(seven, 2e-4);
  // Cubic interpolation: twice the spans (4 to 8), about 1/16 of the error.
  EXPECT_LE(sphereFitError(11), seven / 10.0);
}

TEST(Sphere, HasTheVolumeAndAreaOfTheFormula) {
  const SurfaceEvaluator surface(makeSphere(25.0));
  EXPECT_NEAR(volume(surface), 4.0 / 3.0 * kPi * std::pow(25.0, 3), 1e-4 * 65450.0);
  EXPECT_NEAR(area(surface), 4.0 * kPi * 625.0, 1e-4 * 7854.0);
}

TEST(Sphere, IsOneSmoothGroup) {
  const Solid sphere = makeSphere(3.0);
  const SurfaceEvaluator surface(sphere);
  EXPECT_EQ(sphere.edges().size(), 12U);
  EXPECT_EQ(smoothingGroups(sphere, sharpEdges(sphere, surface)), std::vector<int>(6, 0));
}

TEST(Sphere, NormalsPointAwayFromTheCentre) {
  const Solid sphere = makeSphere(25.0);
  const SurfaceEvaluator surface(sphere);
  forGrid(sphere, 8, [&](int p, double u, double v) {
    EXPECT_GT(surface.normal(p, u, v).dot(surface.position(p, u, v).normalized()), 0.9999);
  });
}

TEST(Cylinder, SidesAndRimsAreRound) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const SurfaceEvaluator surface(cylinder);
  double worst = 0.0;
  for (int p = 0; p < 4; ++p)
    for (int i = 0; i <= 400; ++i) {
      const Eigen::Vector3d x = surface.position(p, i / 400.0, 0.3);
      worst = std::max(worst, std::abs(x.head<2>().norm() / 20.0 - 1.0));
      EXPECT_NEAR(x.z(), 18.0, 1e-12);
    }
  EXPECT_LE(worst, 1e-4);
}

TEST(Cylinder, HasVolumeAreaAndThreeGroups) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const SurfaceEvaluator surface(cylinder);
  EXPECT_NEAR(volume(surface) / (kPi * 400.0 * 60.0), 1.0, 1e-4);
  EXPECT_NEAR(area(surface) / (2.0 * kPi * 400.0 + 2.0 * kPi * 20.0 * 60.0), 1.0, 1e-3);
  const std::vector<int> groups = smoothingGroups(cylinder, sharpEdges(cylinder, surface));
  EXPECT_EQ(groups, (std::vector<int>{0, 0, 0, 0, 1, 2}));
}

TEST(Cylinder, CapsAreFlatWithNormalsAlongTheAxisUpToTheCorners) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const SurfaceEvaluator surface(cylinder);
  const int top = *cylinder.findPatch("top");
  for (double u : {0.0, 0.5, 1.0})
    for (double v : {0.0, 0.5, 1.0})
      EXPECT_NEAR(surface.normal(top, u, v).z(), 1.0, 1e-12) << u << ' ' << v;
}

TEST(Box, IsExact) {
  const Solid box = makeBox({40.0, 30.0, 20.0});
  const SurfaceEvaluator surface(box);
  EXPECT_NEAR(volume(surface), 24000.0, 1e-8);
  EXPECT_NEAR(area(surface), 2.0 * (1200.0 + 800.0 + 600.0), 1e-8);
  const auto [low, high] = boundingBox(box);
  EXPECT_LT((low - Eigen::Vector3d(-20, -15, 0)).norm(), 1e-12);
  EXPECT_LT((high - Eigen::Vector3d(20, 15, 20)).norm(), 1e-12);
  EXPECT_EQ(smoothingGroups(box, sharpEdges(box, surface)), (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST(Primitives, NameTheirFaces) {
  for (const Solid& solid : {makeSphere(1.0), makeCylinder(1.0, 2.0), makeBox({1, 2, 3})}) {
    const auto [low, high] = boundingBox(solid);
    const SurfaceEvaluator surface(solid);
    const auto middle = [&](const char* name) {
      return surface.position(*solid.findPatch(name), 0.5, 0.5);
    };
    EXPECT_NEAR(middle("top").z(), high.z(), 0.1);
    EXPECT_NEAR(middle("bottom").z(), low.z(), 0.1);
    EXPECT_NEAR(middle("side_xmin").x(), low.x(), 0.1);
    EXPECT_NEAR(middle("side_xmax").x(), high.x(), 0.1);
    EXPECT_NEAR(middle("side_ymin").y(), low.y(), 0.1);
    EXPECT_NEAR(middle("side_ymax").y(), high.y(), 0.1);
  }
}

TEST(Primitives, RefuseImpossibleLengthsAndNameThem) {
  const auto message = [](auto make) -> std::string {
    try {
      make();
    } catch (const ModelingError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message([] { makeSphere(-1.0); }).find("sphere: the radius is -1 mm"), 0U);
  EXPECT_EQ(message([] { makeCylinder(1.0, 0.0); }).find("cylinder: the height is 0 mm"), 0U);
  EXPECT_EQ(message([] {
              makeBox({1, std::numeric_limits<double>::quiet_NaN(), 1});
            }).find("box: the size in y is nan"),
            0U);
  EXPECT_EQ(message([] { makeSphere(1e300); }).find("sphere: the radius is 1e+300 mm"), 0U);
  EXPECT_EQ(message([] { makeSphere(1.0, 3); }).find("sphere: 3 control points"), 0U);
}

}  // namespace
}  // namespace palpa::modeling
