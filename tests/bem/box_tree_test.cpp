#include "base/box_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "app/verification/exact/simple_meshes.h"
#include "bem/model/triangle_tree.h"

namespace palpa {
namespace {

using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Random {
 public:
  Vector3d vector(double size) {
    return size * Vector3d(uniform_(engine_), uniform_(engine_), uniform_(engine_));
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(BoxTree, TheNearestPointIsThatOfTryingEveryTriangle) {
  const bem::BoundaryMesh mesh = verification::sphereMesh(25, 10);
  const bem::TriangleTree tree(mesh);
  Random random;
  for (int k = 0; k < 300; ++k) {
    const Vector3d point = random.vector(40);
    const bem::SurfacePoint expected = nearestSurfacePoint(mesh, point);
    const bem::SurfacePoint found = tree.nearest(point);
    EXPECT_EQ(found.distance, expected.distance);
    EXPECT_LE((found.position - expected.position).norm(), 1e-12);
    // A bound on the distance changes nothing, down to the chosen one of equally near triangles.
    const bem::SurfacePoint bounded = tree.nearest(point, 1.01 * found.distance + 1e-9);
    EXPECT_EQ(bounded.triangle, found.triangle);
    EXPECT_EQ(bounded.weights, found.weights);
    EXPECT_EQ(tree.nearest(point, 0.9 * found.distance).triangle, -1);
  }
}

/// Overlapping pairs and items along a ray, before and after the boxes have moved.
TEST(BoxTree, FindsOverlapsAndHitsAlsoAfterARefit) {
  Random random;
  std::vector<BoxTree::Box> boxes;
  std::vector<Vector3d> centres;
  for (int k = 0; k < 200; ++k) {
    centres.push_back(random.vector(10));
    const Vector3d half = random.vector(2).cwiseAbs();
    boxes.emplace_back(centres.back() - half, centres.back() + half);
  }
  BoxTree tree(boxes, centres);
  for (const bool isMoved : {false, true}) {
    if (isMoved) {
      for (auto& box : boxes) box.translate(random.vector(5));
      tree.refit(boxes);
    }
    std::set<std::pair<int, int>> expected, found;
    for (int a = 0; a < 200; ++a)
      for (int b = a + 1; b < 200; ++b)
        if (boxes[a].intersects(boxes[b])) expected.emplace(a, b);
    tree.visitOverlaps(boxes, [&](int a, int b) { return found.emplace(a, b).second; });
    EXPECT_GT(expected.size(), 20U);
    EXPECT_EQ(found, expected);

    // Rays from corners of boxes run within their sides; the others pass through centres.
    for (int k = 0; k < 200; ++k) {
      const Vector3d origin = k % 2 == 0 ? Vector3d(boxes[k].max()) : random.vector(20);
      const Vector3d direction =
          k % 2 == 0 ? Vector3d(-Vector3d::Unit(k % 3)) : Vector3d(boxes[k].center() - origin);
      bool isSeen = false;
      tree.visitAlong(origin, direction, kInfinity, [&](int item, double reach) {
        isSeen = isSeen || item == k;
        return reach;
      });
      EXPECT_TRUE(isSeen) << k;
    }
  }
}

TEST(BoxTree, WithoutItemsFindsNothing) {
  const BoxTree tree(std::vector<BoxTree::Box>{}, {});
  const auto fail = [](int, double reach) {
    ADD_FAILURE();
    return reach;
  };
  tree.visitNear(Vector3d::Zero(), kInfinity, fail);
  tree.visitAlong(Vector3d::Zero(), Vector3d::UnitX(), kInfinity, fail);
}

}  // namespace
}  // namespace palpa
