#include "modeling/mesh/knife_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modeling/body/mesh_body.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/small_features.h"
#include "modeling/mesh/surface_boolean.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kThinnest = 0.4;

/// Prism over a polygon (counter-clockwise) that is seen whole from `center`. Faces: bottom, top,
/// and one per side.
FacedTriangles prism(const std::vector<Vector2d>& polygon, const Vector2d& center, double height) {
  FacedTriangles surface;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {0.0, height}) {
    for (const Vector2d& p : polygon) surface.positions.emplace_back(p.x(), p.y(), z);
    surface.positions.emplace_back(center.x(), center.y(), z);
  }
  const auto add = [&](int a, int b, int c, int face) {
    surface.triangles.push_back({a, b, c});
    surface.faceOfTriangle.push_back(face);
  };
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n, above = n + 1;
    add(j, i, n, 0);
    add(above + i, above + j, above + n, 1);
    add(i, j, above + j, 2 + i);
    add(i, above + j, above + i, 2 + i);
  }
  return surface;
}

/// A block with a blade of 6 mm at its upper edge. Its sides are the faces 4 and 5.
FacedTriangles blade(double degrees) {
  const double rise = 6 * std::tan(degrees * std::numbers::pi / 180);
  return prism({{0, 0}, {10, 0}, {10, 4 - rise}, {16, 4}, {0, 4}}, {9.5, 4 - 0.7 * rise}, 5);
}

/// Two cones with a common rim of radius 10.
FacedTriangles lens(double degrees, int sides) {
  FacedTriangles surface;
  const double height = 10 * std::tan(degrees / 2 * std::numbers::pi / 180);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    surface.positions.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 0);
    const int next = (i + 1) % sides;
    surface.triangles.push_back({i, next, sides});
    surface.triangles.push_back({next, i, sides + 1});
    surface.faceOfTriangle.insert(surface.faceOfTriangle.end(), {0, 1});
  }
  surface.positions.emplace_back(0, 0, height);
  surface.positions.emplace_back(0, 0, -height);
  return surface;
}

/// Checks the invariants of a mesh body on the way.
MeshBody bodyOf(const FacedTriangles& surface) {
  MeshBody::Data data{surface.positions, surface.triangles, {}, {"all"}};
  data.faceOfTriangle.assign(surface.triangles.size(), 0);
  return MeshBody(std::move(data));
}

int count(const FacedTriangles& surface, const std::set<int>& keptFaces = {}) {
  return withoutKnifeEdges(surface, kThinnest, keptFaces).edges;
}

TEST(KnifeEdges, AreCutOffWhereTheBodyIsAsThickAsWanted) {
  const FacedTriangles whole = blade(10);
  const auto [left, edges] = withoutKnifeEdges(whole, kThinnest, {});
  EXPECT_EQ(edges, 1);
  // The missing wedge is as thick as wanted, or up to a fifth thicker, at its base.
  const double tangent = std::tan(5 * std::numbers::pi / 180), base = kThinnest / 2;
  const double wedge = base * base / tangent * 5;
  const double missing = volume(bodyOf(whole)) - volume(bodyOf(left));
  EXPECT_GT(missing, wedge);
  EXPECT_LT(missing, 1.2 * 1.2 * wedge);
  EXPECT_EQ(count(left), 0);
  // No triangle changes its face: the new one belongs to a side of the blade.
  const std::set<int> faces(left.faceOfTriangle.begin(), left.faceOfTriangle.end());
  EXPECT_EQ(faces, (std::set<int>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(KnifeEdges, ClosedOnesAreCutOffInOnePiece) {
  const FacedTriangles whole = lens(15, 48);
  const auto [left, edges] = withoutKnifeEdges(whole, kThinnest, {});
  EXPECT_EQ(edges, 1);
  double radius = 0;
  for (const Vector3d& p : left.positions) radius = std::max(radius, p.head<2>().norm());
  const double depth = kThinnest / 2 / std::tan(7.5 * std::numbers::pi / 180);
  EXPECT_LT(radius, 10 - depth);
  EXPECT_GT(radius, 10 - 1.3 * depth);
  EXPECT_LT(volume(bodyOf(left)), volume(bodyOf(whole)));
}

// Where it ends at a wall, the cut runs out in front of it: a groove would be a feature again.
TEST(KnifeEdges, OnAFloorLeaveIt) {
  const double floor = 0.01;
  FacedTriangles base = prism({{-2, -2}, {20, -2}, {20, 6}, {-2, 6}}, {5, 2}, 1);
  for (Vector3d& p : base.positions) p.z() += floor - 1;
  auto whole = unionOf(base, blade(10));
  ASSERT_TRUE(whole);
  whole->faceOfTriangle.assign(whole->triangles.size(), 0);
  const auto [left, edges] = withoutKnifeEdges(*whole, kThinnest, {});
  EXPECT_EQ(edges, 1);
  EXPECT_LT(volume(bodyOf(left)), volume(bodyOf(*whole)) - 1);
  double reach = 0;
  for (const Vector3d& p : left.positions) {
    EXPECT_TRUE(p.z() > floor - 1e-9 || p.z() < floor - 1 + 1e-9) << p.transpose();
    if (p.z() > 4.9) reach = std::max(reach, p.x());
  }
  EXPECT_LT(reach, 14);
}

TEST(KnifeEdges, OtherEdgesStay) {
  EXPECT_EQ(count(blade(25)), 0);
  EXPECT_EQ(count(lens(25, 48)), 0);
  EXPECT_EQ(withoutKnifeEdges(blade(10), 0, {}).edges, 0);
  // A notch in the body.
  EXPECT_EQ(count(prism({{0, 0}, {10, 0}, {10, 2}, {4, 2.53}, {10, 3.06}, {10, 5}, {0, 5}},
                        {2, 2.53}, 5)),
            0);
  // A plate that is thinner than wanted everywhere.
  EXPECT_EQ(count(prism({{0, 0}, {10, 0}, {10, 0.2}, {0, 0.2}}, {5, 0.1}, 10)), 0);
  // A ridge that is: nothing of it would be left.
  EXPECT_EQ(count(prism({{0, -0.15}, {2, 0}, {0, 0.15}}, {0.5, 0}, 10)), 0);
}

TEST(KnifeEdges, OfNamedFacesStay) {
  EXPECT_EQ(count(blade(10), {4}), 0);
  EXPECT_EQ(count(blade(10), {5}), 0);
  EXPECT_EQ(count(blade(10), {6}), 1);
}

TEST(KnifeEdges, AreMissingInAMesh) {
  const MeshBody body = bodyOf(blade(10));
  const auto two = [](const Vector3d&) { return 2.0; };
  EXPECT_EQ(withoutSmallFeatures(body, two, two, {}, ThinPlaces::kRemoved).cutPins, 1);
  EXPECT_EQ(withoutSmallFeatures(body, two, two, {}, ThinPlaces::kKept).cutPins, 0);
  MeshSettings settings;
  settings.engine = Engine::kQuadratic;
  settings.edgeLength = 2;
  const SurfaceMesh result = mesh(Body(body), settings);
  EXPECT_EQ(result.simplification.cutPins, 1);
  double reach = 0;
  for (const Vector3d& p : result.positions) reach = std::max(reach, p.x());
  EXPECT_LT(reach, 15);
  EXPECT_GT(reach, 12);
}

TEST(KnifeEdges, CanBeCancelled) {
  std::stop_source source;
  source.request_stop();
  Job job;
  job.stop = source.get_token();
  EXPECT_THROW(withoutKnifeEdges(blade(10), kThinnest, {}, job), Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
