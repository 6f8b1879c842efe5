#include "modeling/mesh/small_features.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "mesh_checks.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/triangle_crossings.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight = 20;
const LengthAt kTwo = [](const Vector3d&) { return 2.0; };

/// Prism along z over an outline whose points all see (20, 15); sides are "side 1", "side 2", …
MeshBody prism(const std::vector<Vector2d>& outline) {
  MeshBody::Data data;
  const int count = static_cast<int>(outline.size());
  for (const double z : {0.0, kHeight}) {
    for (const Vector2d& p : outline) data.positions.emplace_back(p.x(), p.y(), z);
    data.positions.emplace_back(20, 15, z);
  }
  data.faceNames = {"bottom", "top"};
  const auto add = [&data](int a, int b, int c, int face) {
    data.triangles.push_back({a, b, c});
    data.faceOfTriangle.push_back(face);
  };
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count, up = count + 1;
    data.faceNames.push_back("side " + std::to_string(i + 1));
    add(next, i, count, 0);
    add(up + i, up + next, up + count, 1);
    add(i, next, up + next, 2 + i);
    add(i, up + next, up + i, 2 + i);
  }
  return MeshBody(std::move(data));
}

MeshBody plainBlock() {
  return prism({{0, 0}, {40, 0}, {40, 30}, {0, 30}});
}

/// A block with a groove 0.3 deep in the middle of its front. "side 3" is the groove's bottom.
MeshBody groovedBlock() {
  return prism(
      {{0, 0}, {19.5, 0}, {19.85, 0.3}, {20.15, 0.3}, {20.5, 0}, {40, 0}, {40, 30}, {0, 30}});
}

MeshSettings settings(double edgeLength) {
  MeshSettings settings;
  settings.edgeLength = edgeLength;
  settings.engine = Engine::kTriangles;
  return settings;
}

double distanceFrom(const SurfaceMesh& mesh, const Vector3d& x) {
  std::vector<std::array<Vector3d, 3>> corners;
  for (const auto& [a, b, c] : mesh.triangles)
    corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
  return (NearestOnTriangles(corners).nearest(x) - x).norm();
}

TEST(SmallFeatures, AreMeshedOver) {
  const MeshBody body = groovedBlock();
  const SurfaceMesh result = mesh(body, settings(4));
  const SurfaceMesh plain = mesh(plainBlock(), settings(4));
  const auto nodes = static_cast<double>(result.positions.size());
  EXPECT_NEAR(nodes / static_cast<double>(plain.positions.size()), 1, 0.15);
  EXPECT_NEAR(estimateNodeCount(body, settings(4)) / nodes, 1, 0.25);
  EXPECT_GT(measureQuality(result).smallestAngle, 20);
  EXPECT_GT(measureQuality(result).shortestEdge, 1);
  EXPECT_EQ(checks::manifoldFault(result), "");
  EXPECT_DOUBLE_EQ(result.simplification.below, 1);
  EXPECT_GT(result.simplification.moved, 0.05);
  EXPECT_LT(result.simplification.moved, 0.35);  // no more than the groove is deep
  EXPECT_GT(result.simplification.vanishedFaces, 0);
  EXPECT_NEAR(checks::enclosedVolume(result) / volume(body), 1, 1e-3);
  EXPECT_EQ(plain.simplification.below, 0);
  EXPECT_EQ(plain.simplification.moved, 0);
}

TEST(SmallFeatures, StayIfTheFractionIsZero) {
  MeshSettings all = settings(4);
  all.featureFraction = 0;
  const SurfaceMesh result = mesh(groovedBlock(), all);
  EXPECT_EQ(result.simplification.below, 0);
  EXPECT_LT(distanceFrom(result, {19.85, 0.3, 10}), 1e-9);
  EXPECT_NEAR(checks::enclosedVolume(result), volume(groovedBlock()), 1e-6);
  EXPECT_GT(result.positions.size(), mesh(groovedBlock(), settings(4)).positions.size());
}

TEST(SmallFeatures, StayWhereARegionNamesThem) {
  const SurfaceMesh result =
      mesh(groovedBlock(), settings(4), {{{"groove", Region::ofPatches({"side 3"}), true}}});
  EXPECT_NEAR(checks::regionArea(result, 0), 0.3 * kHeight, 1e-6);
}

TEST(SmallFeatures, StayUnderATouch) {
  const MeshFocus focus{{20, 0.3, 10}, 1, 0.4};
  const SurfaceMesh result = mesh(groovedBlock(), settings(4), {}, {}, {{focus}});
  EXPECT_LT(distanceFrom(result, {19.85, 0.3, 10}), 0.02);
  EXPECT_GT(distanceFrom(mesh(groovedBlock(), settings(4)), {20, 0.3, 10}), 0.05);
}

TEST(SmallFeatures, ThinWallsDoNotCutThroughThemselves) {
  for (const double wall : {0.3, 1.1}) {
    const MeshBody tube = test::boredCylinder(20, 20 - wall, 30, 64);
    const SurfaceMesh result = mesh(tube, settings(4));
    EXPECT_TRUE(triangleCrossings(result.positions, result.triangles).empty()) << wall;
    EXPECT_GT(measureQuality(result).smallestAngle, 1) << wall;
    EXPECT_NEAR(checks::enclosedVolume(result) / volume(tube), 1, 0.3) << wall;
  }
}

TEST(SmallFeatures, MiddleNodesStayOnTheSimplifiedSurface) {
  MeshSettings quadratic = settings(2);
  quadratic.engine = Engine::kQuadratic;
  const SurfaceMesh result = mesh(Body(groovedBlock()), quadratic);
  ASSERT_TRUE(result.isQuadratic);
  EXPECT_GT(result.simplification.below, 0);
  EXPECT_EQ(checks::manifoldFault(result), "");
  EXPECT_GT(measureQuality(result).smallestAngle, 10);
  EXPECT_TRUE(triangleCrossings(result.positions, result.triangles).empty());
}

TEST(SmallFeatures, CurvedSurfacesStayRound) {
  const MeshBody body = test::icosphere(10, 5);
  const SimplifiedSurface sphere = withoutSmallFeatures(body, kTwo, kTwo, {}, ThinPlaces::kRemoved);
  EXPECT_FALSE(sphere.isNeeded);
  EXPECT_LT(sphere.positions.size(), body.positions().size());
  for (const Vector3d& x : sphere.positions) EXPECT_NEAR(x.norm(), 10, 0.3);
}

TEST(SmallFeatures, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  Job job;
  job.stop = stop.get_token();
  EXPECT_THROW(withoutSmallFeatures(groovedBlock(), kTwo, kTwo, {}, ThinPlaces::kRemoved, job),
               Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
