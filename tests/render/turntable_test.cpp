#include "app/view/camera/turntable.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Bounds box(const Vector3d& low, const Vector3d& high) {
  Bounds bounds;
  bounds.add(low);
  bounds.add(high);
  return bounds;
}

/// A camera that sees a cube of side 20 about (5, -3, 8), both projections.
class TurntableTest : public testing::TestWithParam<bool> {
 protected:
  TurntableTest() {
    camera.setSize(1280, 800);
    camera.setScene(scene);
    camera.setParallel(GetParam());
    camera.fit({corners.begin(), corners.end()}, 60);
  }

  Bounds scene = box({-5, -13, -2}, {15, 7, 18});
  std::array<Vector3d, 8> corners = scene.corners();
  Turntable camera;
};

INSTANTIATE_TEST_SUITE_P(Projections, TurntableTest, testing::Bool(), [](const auto& parameter) {
  return parameter.param ? "parallel" : "perspective";
});

void expectNear(const Vector2d& a, const Vector2d& b, double tolerance = 1e-8) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
}

TEST_P(TurntableTest, FitLeavesRoomAtTheEdges) {
  const Reserve reserve{150, 80, 40};
  camera.fit({corners.begin(), corners.end()}, 60, reserve);
  Vector2d low(1e9, 1e9);
  Vector2d high(-1e9, -1e9);
  for (const Vector3d& corner : corners) {
    low = low.cwiseMin(camera.toPixel(corner));
    high = high.cwiseMax(camera.toPixel(corner));
  }
  // Perspective moves near points a little further than far ones.
  EXPECT_LT(high.x(), 1280 - reserve.right - 60 + 20);
  EXPECT_NEAR((low.x() + high.x()) / 2, (1280 - reserve.right) / 2, 25);
  EXPECT_GE(low.y(), 60 + reserve.top - 12);
  EXPECT_LE(high.y(), 740 - reserve.bottom + 12);
}

TEST_P(TurntableTest, FitShowsEverythingAndTouchesTwoMargins) {
  Vector2d low(1e9, 1e9);
  Vector2d high(-1e9, -1e9);
  for (const Vector3d& corner : corners) {
    low = low.cwiseMin(camera.toPixel(corner));
    high = high.cwiseMax(camera.toPixel(corner));
  }
  EXPECT_NEAR(low.y(), 60, 0.1);
  EXPECT_NEAR(high.y(), 740, 0.1);
  EXPECT_NEAR(0.5 * (low.x() + high.x()), 640, 0.1);
  EXPECT_GT(low.x(), 60);
}

TEST_P(TurntableTest, TheRayUnderAPointsPixelMeetsThePoint) {
  for (const Vector3d& corner : corners) {
    const Ray ray = camera.ray(camera.toPixel(corner));
    EXPECT_NEAR(ray.direction.norm(), 1, 1e-14);
    EXPECT_NEAR((corner - ray.origin).cross(ray.direction).norm(), 0, 1e-10);
    EXPECT_GT((corner - ray.origin).dot(ray.direction), 0);
  }
}

TEST_P(TurntableTest, ViewPlaneRoundTrip) {
  const Vector3d through(3, 4, 5);
  const Vector2d pixel(333, 444);
  const Vector3d point = camera.inViewPlane(pixel, through);
  expectNear(camera.toPixel(point), pixel);
  EXPECT_NEAR((point - through).dot(camera.axes().forward), 0, 1e-10);
}

TEST_P(TurntableTest, PanningMovesThePointWithThePointer) {
  const Vector3d point = corners[3];
  const Vector2d before = camera.toPixel(point);
  camera.pan({37, -81}, point);
  expectNear(camera.toPixel(point), before + Vector2d(37, -81));
}

TEST_P(TurntableTest, ZoomingKeepsThePointInPlace) {
  const Vector3d point = corners[6];
  const Vector2d before = camera.toPixel(point);
  const double scale = camera.pixelsPerLength(camera.depth(point));
  camera.zoom(1.7, point);
  expectNear(camera.toPixel(point), before);
  EXPECT_NEAR(camera.pixelsPerLength(camera.depth(point)), 1.7 * scale, 1e-9 * scale);
  camera.zoom(1 / 1.7, point);
  EXPECT_NEAR(camera.pixelsPerLength(camera.depth(point)), scale, 1e-9 * scale);
}

TEST_P(TurntableTest, ZoomEndsAtLimitsAndStaysFinite) {
  const Vector3d point = corners[0];
  const double radius = 0.5 * scene.size().norm();
  for (int i = 0; i < 500; ++i) camera.zoom(1.5, point);
  EXPECT_NEAR(camera.distance(), 2e-3 * radius, 1e-12);
  EXPECT_TRUE(camera.eye().allFinite());
  const Vector3d eye = camera.eye();
  camera.zoom(1.5, point);
  EXPECT_EQ(camera.eye(), eye);  // at the limit nothing moves
  for (int i = 0; i < 500; ++i) camera.zoom(0.5, point);
  EXPECT_NEAR(camera.distance(), 200 * radius, 1e-9);
  EXPECT_TRUE(camera.toPixel(point).allFinite());
}

TEST_P(TurntableTest, OrbitKeepsTheFocusAndTheVerticalUpright) {
  for (int i = 0; i < 200; ++i) {
    camera.orbit(0.31, i % 7 < 4 ? 0.4 : -0.45);
    expectNear(camera.toPixel(camera.focus()), {640, 400});
    const ViewAxes axes = camera.axes();
    EXPECT_GE(axes.up.z(), -1e-15);
    EXPECT_EQ(axes.right.z(), 0);
    EXPECT_NEAR(axes.right.cross(axes.forward).dot(axes.up), 1, 1e-12);
  }
}

TEST_P(TurntableTest, TiltEndsAtThePoles) {
  const Vector3d right = camera.axes().right;
  for (int i = 0; i < 50; ++i) camera.orbit(0, -0.2);
  EXPECT_NEAR(camera.axes().forward.z(), -1, 1e-15);
  EXPECT_NEAR((camera.axes().right - right).norm(), 0, 1e-12);
  for (int i = 0; i < 50; ++i) camera.orbit(0, 0.2);
  EXPECT_NEAR(camera.axes().forward.z(), 1, 1e-15);
}

TEST_P(TurntableTest, TheOtherProjectionHasTheSameSizeAtTheFocus) {
  const Vector3d beside = camera.focus() + 3 * camera.axes().right - 2 * camera.axes().up;
  const Vector2d before = camera.toPixel(beside);
  camera.setParallel(!camera.parallel());
  expectNear(camera.toPixel(beside), before);
}

TEST_P(TurntableTest, ClippingRangeHoldsTheScene) {
  for (const double factor : {1.0, 4.0, 30.0, 0.02}) {
    Turntable other = camera;
    other.zoom(factor, corners[1]);
    const auto [near, far] = other.clippingRange(scene);
    EXPECT_GT(near, 0);
    EXPECT_GT(far, near);
    for (const Vector3d& corner : corners) {
      EXPECT_LT(other.depth(corner), far);
      // In perspective the range cannot include points (almost) behind the eye.
      if (other.parallel() || other.depth(corner) > 0.03 * other.distance()) {
        EXPECT_GT(other.depth(corner), near);
      }
    }
  }
}

TEST(Turntable, PixelsOfAKnownView) {
  Turntable camera;
  camera.setSize(200, 100);
  camera.setDirection({0, 1, 0}, {0, 0, 1});
  camera.setParallel(true);
  camera.setScene(box({-10, -10, -10}, {10, 10, 10}));
  camera.setDistance(50 / (2 * std::tan(kVerticalViewAngle / 2)));  // 50 mm are visible: 2 px/mm
  expectNear(camera.toPixel({0, 7, 0}), {100, 50});
  expectNear(camera.toPixel({10, -3, 5}), {120, 40});
  const Ray ray = camera.ray({120, 40});
  EXPECT_NEAR(ray.origin.x(), 10, 1e-12);
  EXPECT_NEAR(ray.origin.z(), 5, 1e-12);
  EXPECT_NEAR((ray.direction - Vector3d::UnitY()).norm(), 0, 1e-15);
}

TEST(Turntable, TopAndBottomAreUprightAsAsked) {
  Turntable camera;
  camera.setDirection({0, 0, -1}, {0, 1, 0});
  EXPECT_NEAR((camera.axes().up - Vector3d::UnitY()).norm(), 0, 1e-15);
  EXPECT_NEAR((camera.axes().right - Vector3d::UnitX()).norm(), 0, 1e-15);
  camera.setDirection({0, 0, 1}, {0, -1, 0});
  EXPECT_NEAR((camera.axes().up + Vector3d::UnitY()).norm(), 0, 1e-15);
  EXPECT_NEAR((camera.axes().right - Vector3d::UnitX()).norm(), 0, 1e-15);
}

TEST(Turntable, APointBehindTheEyeHasNoPixel) {
  Turntable camera;
  camera.setSize(200, 100);
  const Vector3d behind = camera.eye() - 5 * camera.axes().forward;
  EXPECT_FALSE(camera.toPixel(behind).allFinite());
  EXPECT_FALSE(camera.toPixel(camera.eye()).allFinite());
}

TEST_P(TurntableTest, FittingALineSeenEndOnStaysOutsideOfIt) {
  const Vector3d along = camera.axes().forward;
  const std::vector<Vector3d> line{Vector3d(1, 2, 3), Vector3d(1, 2, 3) + 5 * along};
  camera.fit(line, 60);
  expectNear(camera.toPixel(line[0]), {640, 400}, 1e-6);
  EXPECT_GT(camera.depth(line[0]), 1);
}

TEST(Turntable, EmptySceneZeroSizeAndSinglePointStayFinite) {
  Turntable camera;
  camera.setSize(0, 0);
  camera.setScene({});
  camera.fit({}, 10);
  const double distance = camera.distance();
  camera.fit({Vector3d(1, 2, 3), Vector3d(1, 2, 3)}, 10);
  EXPECT_TRUE(camera.focus().isApprox(Vector3d(1, 2, 3)));
  EXPECT_EQ(camera.distance(), distance);
  EXPECT_TRUE(camera.eye().allFinite());
  EXPECT_TRUE(camera.ray({0, 0}).direction.allFinite());
  const auto [near, far] = camera.clippingRange({});
  EXPECT_GT(near, 0);
  EXPECT_GT(far, near);
}

}  // namespace
}  // namespace palpa::view
