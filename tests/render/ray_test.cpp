#include "app/view/camera/ray.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "app/view/camera/triangle_boxes.h"
#include "tests/render/shapes.h"

namespace palpa::view {
namespace {

using Eigen::Vector3d;

std::optional<RayHit> firstHit(const Ray& ray, const std::vector<Vector3d>& positions,
                               const std::vector<Triangle>& triangles) {
  TriangleBoxes boxes;
  boxes.set(positions, triangles);
  return boxes.firstHit(ray, positions, triangles);
}

TEST(Ray, HitsTheNearerSideOfABox) {
  const render_tests::Shape box = render_tests::box({40, 30, 20}, 5);
  const auto hit = firstHit({{1, 2, 100}, -Vector3d::UnitZ()}, box.positions, box.triangles);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 80, 1e-12);
  for (const int corner : box.triangles[static_cast<std::size_t>(hit->triangle)]) {
    EXPECT_EQ(box.positions[static_cast<std::size_t>(corner)].z(), 20);
  }
}

TEST(Ray, FromInsideHitsTheInside) {
  const render_tests::Shape box = render_tests::box({40, 30, 20}, 5);
  const auto hit = firstHit({{0.3, 0.2, 4}, Vector3d::UnitX()}, box.positions, box.triangles);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 19.7, 1e-12);
}

TEST(Ray, MissesBesideAndBehind) {
  const render_tests::Shape box = render_tests::box({40, 30, 20}, 5);
  EXPECT_FALSE(firstHit({{20.001, 0, 100}, -Vector3d::UnitZ()}, box.positions, box.triangles));
  EXPECT_FALSE(firstHit({{0, 0, 100}, Vector3d::UnitZ()}, box.positions, box.triangles));
  EXPECT_FALSE(firstHit({{0, 0, 100}, -Vector3d::UnitZ()}, {}, {}));
}

TEST(Ray, SlipsThroughNoEdgeOrCorner) {
  const render_tests::Shape sphere = render_tests::sphere(25, 6);
  for (const Triangle& t : sphere.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d& a =
          sphere.positions[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
      const Vector3d& b =
          sphere.positions[static_cast<std::size_t>(t[static_cast<std::size_t>((k + 1) % 3)])];
      for (const Vector3d& target : {a, Vector3d(0.5 * (a + b)), Vector3d(0.3 * a + 0.7 * b)}) {
        const Vector3d eye = 4 * target + Vector3d(1, 2, 3);
        const Vector3d direction = (target - eye).normalized();
        const auto hit = firstHit({eye, direction}, sphere.positions, sphere.triangles);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, (target - eye).norm(), 1e-9);
      }
    }
  }
}

TEST(Ray, DegenerateTrianglesAreNeverHit) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 0, 0}, {0, 3, 1}};
  EXPECT_FALSE(firstHit({{0.5, 0, 5}, -Vector3d::UnitZ()}, points, triangles));
}

TEST(Ray, BoxesFindWhatTryingAllTrianglesFinds) {
  render_tests::Shape sphere = render_tests::sphere(25, 12);
  TriangleBoxes boxes;
  boxes.set(sphere.positions, sphere.triangles);
  for (const double stretch : {1.0, 0.2, 3.0}) {
    for (Vector3d& position : sphere.positions) position.x() *= stretch;
    boxes.move();
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector3d eye(90 * std::cos(i), 90 * std::sin(1.7 * i), 60 * std::sin(0.6 * i));
      const Vector3d target(20 * std::sin(2.3 * i), 30 * std::cos(0.9 * i), 10 * std::sin(i));
      const Ray ray{eye, i % 10 == 0 ? Vector3d(-Vector3d::Unit(i % 3))
                                     : Vector3d((target - eye).normalized())};
      std::optional<double> nearest;
      for (const Triangle& triangle : sphere.triangles) {
        const auto distance = distanceTo(ray, sphere.positions, triangle);
        if (distance && (!nearest || *distance < *nearest)) nearest = distance;
      }
      const auto hit = boxes.firstHit(ray, sphere.positions, sphere.triangles);
      ASSERT_EQ(hit.has_value(), nearest.has_value());
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->distance, *nearest);
    }
    EXPECT_GT(hits, 50);
  }
}

TEST(Ray, NearestOnLine) {
  // Skew lines: the ray along x at height 5, the line along y through (3, 1, 0).
  const auto s = nearestOnLine({{-10, 4, 5}, Vector3d::UnitX()}, {3, 1, 0}, {0, 2, 0});
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, 1.5, 1e-14);  // (3, 4, 0)
}

TEST(Ray, NearestOnLineIsTheMinimum) {
  const Ray ray{{1, 2, 3}, Vector3d(0.3, -0.8, 0.5).normalized()};
  const Vector3d through(-2, 0, 1);
  const Vector3d direction(1, 1, -0.4);
  const auto distance = [&](double s) {
    return (through + s * direction - ray.origin).cross(ray.direction).norm();
  };
  const double s = nearestOnLine(ray, through, direction).value();
  EXPECT_LT(distance(s), distance(s + 1e-3));
  EXPECT_LT(distance(s), distance(s - 1e-3));
}

TEST(Ray, ALinePointingAtTheEyeHasNoNearestPoint) {
  EXPECT_FALSE(nearestOnLine({{0, 0, 0}, Vector3d::UnitX()}, {5, 0, 0}, {-3, 0, 0}));
  EXPECT_FALSE(nearestOnLine({{0, 0, 0}, Vector3d::UnitX()}, {5, 1, 0}, {1, 0.01, 0}));
  EXPECT_TRUE(nearestOnLine({{0, 0, 0}, Vector3d::UnitX()}, {5, 1, 0}, {1, 0.03, 0}));
}

}  // namespace
}  // namespace palpa::view
