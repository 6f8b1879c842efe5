#include "app/view/camera/view_cube.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

// Arithmetic of the view cube; nothing is drawn.
namespace palpa::view {
namespace {

using Arrow = ViewCubePart::Arrow;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;

Turntable camera(const Vector3d& direction, const Vector3d& up = Vector3d::UnitZ()) {
  Turntable turntable;
  turntable.setSize(800, 600);
  turntable.setDirection(direction, up);
  return turntable;
}

Vector2d middleOf(const ViewCubePolygon& polygon) {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : polygon.corners) sum += corner;
  return sum / static_cast<double>(polygon.corners.size());
}

TEST(ViewCube, ShowsThePartsOnTheSideOfTheEye) {
  // From the front: its face, four edges and four corners around it, four arrows.
  const auto front = viewCubePolygons(camera({0, 1, 0}), 1);
  EXPECT_EQ(front.size(), 13u);
  for (const ViewCubePolygon& polygon : front) EXPECT_LE(polygon.part.towards.y(), 0);
  // Half of the 26 parts from a direction across none of them, without the opposite ones.
  EXPECT_EQ(viewCubePolygons(camera({-0.72, 0.58, -0.38}), 1).size(), 13u + 4u);
}

TEST(ViewCube, EveryVisiblePartIsUnderItsMiddle) {
  for (const double ratio : {1.0, 2.0}) {
    for (const Vector3d& direction : {Vector3d(0, 1, 0), Vector3d(-0.72, 0.58, -0.38),
                                      Vector3d(0.3, 0.2, 0.9), Vector3d(1, 1, -1)}) {
      const Turntable from = camera(direction);
      for (const ViewCubePolygon& polygon : viewCubePolygons(from, ratio)) {
        if (polygon.facing < 0.1) continue;
        EXPECT_EQ(viewCubePartAt(middleOf(polygon), from, ratio), polygon.part);
      }
    }
  }
}

TEST(ViewCube, LiesInTheUpperRightCorner) {
  const Turntable from = camera({-1, 1, -1});
  for (const ViewCubePolygon& polygon : viewCubePolygons(from, 1)) {
    for (const Vector2d& corner : polygon.corners) {
      EXPECT_GT(corner.x(), 800 - kViewCubeSide - 5);
      EXPECT_LT(corner.x(), 800);
      EXPECT_GT(corner.y(), 0);
      EXPECT_LT(corner.y(), kViewCubeSide + 5);
    }
  }
  EXPECT_FALSE(viewCubePartAt({400, 300}, from, 1));
  EXPECT_FALSE(viewCubePartAt({797, 3}, from, 1));
}

TEST(ViewCube, TurnsToFacesEdgesAndCorners) {
  Turntable turntable = camera({-0.72, 0.58, -0.38});
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector3i towards(x, y, z);
        if (towards.isZero()) continue;
        turnTo({towards, Arrow::kNone}, turntable);
        const Vector3d expected = -towards.cast<double>().normalized();
        EXPECT_NEAR((turntable.axes().forward - expected).norm(), 0, 1e-12);
      }
    }
  }
  // As the standard views: y upwards seen from above, downwards from below.
  turnTo({{0, 0, 1}, Arrow::kNone}, turntable);
  EXPECT_NEAR((turntable.axes().up - Vector3d::UnitY()).norm(), 0, 1e-12);
  turnTo({{0, 0, -1}, Arrow::kNone}, turntable);
  EXPECT_NEAR((turntable.axes().up + Vector3d::UnitY()).norm(), 0, 1e-12);
}

TEST(ViewCube, ArrowsShowTheSideInTheirDirection) {
  const auto after = [](Arrow arrow) {
    Turntable front = camera({0, 1, 0});
    turnTo({Vector3i::Zero(), arrow}, front);
    return Vector3d(front.axes().forward);
  };
  EXPECT_NEAR((after(Arrow::kRight) - Vector3d(-1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((after(Arrow::kLeft) - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((after(Arrow::kUp) - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
  EXPECT_NEAR((after(Arrow::kDown) - Vector3d(0, 0, 1)).norm(), 0, 1e-12);
}

TEST(ViewCube, ArrowsGoOnOverThePoles) {
  // From the front over the top to the back, upright again.
  Turntable turntable = camera({0, 1, 0});
  for (int i = 0; i < 2; ++i) turnTo({Vector3i::Zero(), Arrow::kUp}, turntable);
  EXPECT_NEAR((turntable.axes().forward - Vector3d(0, -1, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((turntable.axes().up - Vector3d::UnitZ()).norm(), 0, 1e-9);
  // From an oblique view by exactly a quarter turn about the horizontal line of the picture.
  Turntable oblique = camera({-0.6, 0.6, -0.4});
  const Vector3d before = oblique.axes().forward, right = oblique.axes().right;
  turnTo({Vector3i::Zero(), Arrow::kUp}, oblique);
  EXPECT_NEAR(before.dot(oblique.axes().forward), 0, 1e-12);
  EXPECT_NEAR(right.dot(oblique.axes().forward), 0, 1e-12);
  // Four times to the right: the same view.
  Turntable around = camera({-0.6, 0.6, -0.4});
  for (int i = 0; i < 4; ++i) turnTo({Vector3i::Zero(), Arrow::kRight}, around);
  EXPECT_NEAR((around.axes().forward - before).norm(), 0, 1e-12);
}

TEST(ViewCube, WordsAreUprightInTheStandardViews) {
  const auto isUpright = [](const Vector3i& face, const Vector3d& direction, const Vector3d& up) {
    const ViewCubeLabel label = viewCubeLabel(face, camera(direction, up), 1);
    EXPECT_GT(label.along.x(), 10);
    EXPECT_NEAR(label.along.y(), 0, 1e-9);
    EXPECT_LT(label.up.y(), -10);
  };
  isUpright({0, -1, 0}, {0, 1, 0}, {0, 0, 1});
  isUpright({0, 1, 0}, {0, -1, 0}, {0, 0, 1});
  isUpright({-1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  isUpright({1, 0, 0}, {-1, 0, 0}, {0, 0, 1});
  isUpright({0, 0, 1}, {0, 0, -1}, {0, 1, 0});
  isUpright({0, 0, -1}, {0, 0, 1}, {0, -1, 0});
}

}  // namespace
}  // namespace palpa::view
