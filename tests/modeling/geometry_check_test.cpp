#include "modeling/mesh/geometry_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/triangle_crossings.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

SurfaceMesh meshOf(const Solid& solid, double h, double below = -1e9) {
  MeshSettings settings;
  settings.edgeLength = h;
  std::vector<MeshRegion> regions;
  if (below > -1e8) regions.push_back({"base", Region::below({0.1, 0.2, 1}, below), true});
  return mesh(solid, settings, regions);
}

std::string allText(const std::vector<GeometryFinding>& findings) {
  std::string text;
  for (const GeometryFinding& f : findings)
    text += std::string(faultName(f.fault)) + ": " + f.message + '\n';
  return text;
}

const GeometryFinding* find(const std::vector<GeometryFinding>& findings, GeometryFault fault) {
  for (const GeometryFinding& f : findings)
    if (f.fault == fault) return &f;
  return nullptr;
}

int controlPointNear(const Solid& solid, const Vector3d& x) {
  int best = 0;
  for (std::size_t i = 0; i < solid.controlPoints().size(); ++i)
    if ((solid.controlPoints()[i] - x).norm() < (solid.controlPoints()[best] - x).norm())
      best = static_cast<int>(i);
  return best;
}

TEST(GeometryCheck, GoodSolidsHaveNoFindings) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-1.0, 1.0);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const Solid& plain : {makeSphere(25.0), makeCylinder(20.0, 60.0), makeBox({40, 30, 20}),
                             makeBox({40, 15, 1}), makeSphere(25.0, 12)})
    for (int trial = 0; trial < 6; ++trial) {
      // Unchanged, rotated (faces are then flat only up to rounding), and slightly perturbed.
      std::vector<Vector3d> points = plain.controlPoints();
      for (Vector3d& p : points) {
        if (trial % 3 > 0) p = turn * p;
        if (trial % 3 > 1) p += 0.1 * Vector3d(by(random), by(random), by(random));
      }
      const Solid solid = plain.withControlPoints(points);
      for (double h : {100.0, 5.0}) {
        const auto findings = checkGeometry(meshOf(solid, h, trial % 2 ? 3.0 : -1e9), solid);
        EXPECT_TRUE(findings.empty()) << trial << ' ' << h << '\n' << allText(findings);
      }
    }
}

TEST(GeometryCheck, AControlPointPulledThroughTheOtherSide) {
  const Solid sphere = makeSphere(25.0);
  std::vector<Vector3d> points = sphere.controlPoints();
  const int top = controlPointNear(sphere, {0, 0, 25});
  points[top] = {0, 0, -150.0};
  const Solid solid = sphere.withControlPoints(points);
  const auto findings = checkGeometry(meshOf(solid, 4.0), solid);
  const GeometryFinding* found = find(findings, GeometryFault::kSelfIntersection);
  ASSERT_TRUE(found) << allText(findings);
  EXPECT_TRUE(found->isError);
  EXPECT_EQ(found->patches, (std::vector<std::string>{"bottom", "top"}));
  // The spike leaves the body near the axis at the bottom.
  EXPECT_NEAR(found->at.z(), -25.0, 2.0);
  EXPECT_LT(found->at.head<2>().norm(), 10.0);
  EXPECT_NE(found->message.find("intersects itself near ("), std::string::npos);
  EXPECT_NE(found->message.find("patches \"bottom\", \"top\""), std::string::npos);
  EXPECT_FALSE(found->triangles.empty());
  EXPECT_TRUE(std::is_sorted(found->triangles.begin(), found->triangles.end()));
}

TEST(GeometryCheck, CrossingFacesOfABox) {
  const Solid box = makeBox({40, 30, 20});
  std::vector<Vector3d> points = box.controlPoints();
  // The inner points of the top are moved below the bottom.
  for (Vector3d& p : points)
    if (p.z() > 19.9 && std::abs(p.x()) < 19.0 && std::abs(p.y()) < 14.0) p.z() = -20.0;
  const Solid solid = box.withControlPoints(points);
  const auto findings = checkGeometry(meshOf(solid, 3.0), solid);
  ASSERT_EQ(findings.size(), 1U) << allText(findings);
  EXPECT_EQ(findings[0].fault, GeometryFault::kSelfIntersection);
  EXPECT_EQ(findings[0].patches, (std::vector<std::string>{"bottom", "top"}));
  EXPECT_NEAR(findings[0].at.z(), 0.0, 0.1);
}

TEST(GeometryCheck, AFaceFoldedInItsOwnPlane) {
  const Solid box = makeBox({40, 30, 20});
  std::vector<Vector3d> points = box.controlPoints();
  // In a row of control points of the top, the two inner points are exchanged and moved far apart.
  for (Vector3d& p : points)
    if (p.z() > 19.9 && std::abs(p.x()) < 19.0 && std::abs(p.y()) < 14.0) p.x() *= -5.0;
  const Solid solid = box.withControlPoints(points);
  const auto findings = checkGeometry(meshOf(solid, 3.0), solid);
  const GeometryFinding* fold = find(findings, GeometryFault::kFoldedPatch);
  ASSERT_TRUE(fold) << allText(findings);
  EXPECT_EQ(fold->patches, std::vector<std::string>{"top"});
  EXPECT_NEAR(fold->at.z(), 20.0, 1e-9);
  EXPECT_TRUE(find(findings, GeometryFault::kSelfIntersection)) << allText(findings);
}

TEST(GeometryCheck, FoundInTheMeshItself) {
  const Solid sphere = makeSphere(25.0);
  const SurfaceMesh good = meshOf(sphere, 6.0);
  {
    SurfaceMesh bad = good;
    // A node is moved across its neighbours, so some of its triangles are inverted.
    const auto [a, b, c] = bad.triangles[10];
    bad.positions[a] += 2.5 * (0.5 * (bad.positions[b] + bad.positions[c]) - bad.positions[a]);
    const auto findings = checkGeometry(bad, sphere);
    const GeometryFinding* found = find(findings, GeometryFault::kInvertedTriangle);
    ASSERT_TRUE(found) << allText(findings);
    EXPECT_TRUE(std::binary_search(found->triangles.begin(), found->triangles.end(), 10));
    EXPECT_NE(found->message.find("into the body near"), std::string::npos);
  }
  {
    SurfaceMesh bad = good;
    const auto [a, b, c] = bad.triangles[10];
    bad.positions[a] = 0.5 * (bad.positions[b] + bad.positions[c]);
    const auto findings = checkGeometry(bad, sphere);
    const GeometryFinding* found = find(findings, GeometryFault::kZeroArea);
    ASSERT_TRUE(found) << allText(findings);
    EXPECT_EQ(found->triangles, std::vector<int>{10});
  }
  {
    SurfaceMesh bad = good;
    bad.triangles.erase(bad.triangles.begin() + 20);
    bad.patchOfTriangle.erase(bad.patchOfTriangle.begin() + 20);
    const auto findings = checkGeometry(bad, sphere);
    ASSERT_EQ(findings.size(), 1U) << allText(findings);
    EXPECT_EQ(findings[0].fault, GeometryFault::kOpenEdge);
    EXPECT_EQ(findings[0].triangles.size(), 3U);
  }
  {
    SurfaceMesh bad = good;
    std::swap(bad.triangles[20][1], bad.triangles[20][2]);
    const auto findings = checkGeometry(bad, sphere);
    EXPECT_TRUE(find(findings, GeometryFault::kWrongOrientation)) << allText(findings);
    EXPECT_FALSE(find(findings, GeometryFault::kOpenEdge));
  }
  {
    SurfaceMesh bad = good;
    for (auto& triangle : bad.triangles) std::swap(triangle[1], triangle[2]);
    const auto findings = checkGeometry(bad, sphere);
    EXPECT_TRUE(find(findings, GeometryFault::kInsideOut)) << allText(findings);
    EXPECT_NE(allText(findings).find("the enclosed volume is -"), std::string::npos);
  }
}

/// Mesh body of two boxes.
MeshBody twoBoxes(const Vector3d& shift) {
  MeshBody::Data data;
  data.faceNames = {"first", "second"};
  const SurfaceMesh box = meshOf(makeBox({10, 10, 10}), 5.0);
  for (int copy : {0, 1}) {
    const int offset = static_cast<int>(data.positions.size());
    for (const Vector3d& x : box.positions) data.positions.push_back(x + copy * shift);
    for (const auto& [a, b, c] : box.triangles) {
      data.triangles.push_back({a + offset, b + offset, c + offset});
      data.faceOfTriangle.push_back(copy);
    }
  }
  return MeshBody(std::move(data));
}

std::vector<GeometryFinding> findingsOf(const MeshBody& body) {
  SurfaceMesh mesh;
  mesh.positions = body.positions();
  mesh.triangles = body.triangles();
  mesh.patchOfTriangle = body.faceOfTriangle();
  return checkGeometry(mesh, body);
}

TEST(GeometryCheck, TouchingIsAWarningAndPassingThroughAnError) {
  EXPECT_TRUE(findingsOf(twoBoxes({10.001, 0, 0})).empty());
  EXPECT_TRUE(findingsOf(twoBoxes({30, 0, 0})).empty());
  const auto touching = findingsOf(twoBoxes({10, 3, 3}));
  ASSERT_EQ(touching.size(), 1U) << allText(touching);
  EXPECT_EQ(touching[0].fault, GeometryFault::kTouching);
  EXPECT_FALSE(touching[0].isError);
  EXPECT_EQ(touching[0].patches, (std::vector<std::string>{"first", "second"}));
  const auto through = findingsOf(twoBoxes({9, 3, 3.1}));
  ASSERT_FALSE(through.empty());
  EXPECT_EQ(through[0].fault, GeometryFault::kSelfIntersection) << allText(through);
  EXPECT_TRUE(through[0].isError);
  // A box inside the other one does not cross it.
  MeshBody::Data nested;
  const MeshBody outer = twoBoxes({30, 0, 0});
  nested.positions = outer.positions();
  nested.triangles = outer.triangles();
  nested.faceOfTriangle = outer.faceOfTriangle();
  nested.faceNames = outer.faceNames();
  for (std::size_t i = nested.positions.size() / 2; i < nested.positions.size(); ++i)
    nested.positions[i] = 0.5 * (nested.positions[i] - Vector3d(30, 0, 0)) + Vector3d(0, 0, 2);
  EXPECT_TRUE(findingsOf(MeshBody(std::move(nested))).empty());
}

bool cross(const std::vector<Vector3d>& x, std::array<int, 3> a, std::array<int, 3> b) {
  const auto found = triangleCrossings(x, {a, b});
  if (!found.empty()) {
    EXPECT_EQ(found[0].a, 0);
    EXPECT_EQ(found[0].b, 1);
  }
  return !found.empty();
}

TEST(TriangleCrossings, KnownPairs) {
  const std::vector<Vector3d> x{{0, 0, 0},    {4, 0, 0},    {0, 4, 0},     // 0 1 2
                                {1, 1, -1},   {1, 1, 1},    {3, 3, 1},     // 3 4 5: through
                                {1, 1, 1e-9}, {2, 1, 1e-9}, {1, 2, 1e-9},  // 6 7 8: just above
                                {1, 1, 0},    {2, 1, 0},    {1, 2, 0},     // 9 10 11: within
                                {-4, -4, 0},  {-1, -4, 0},  {1, 1, 3},     // 12 13 14
                                {4, 4, 0},    {-4, 0, 0},   {4, 1, 0}};    // 15 16 17
  EXPECT_TRUE(cross(x, {0, 1, 2}, {3, 4, 5}));
  EXPECT_FALSE(cross(x, {0, 1, 2}, {6, 7, 8}));
  EXPECT_TRUE(cross(x, {0, 1, 2}, {9, 10, 11}));
  // With a common vertex: apart, and folded into the other.
  EXPECT_FALSE(cross(x, {0, 1, 2}, {0, 12, 13}));
  EXPECT_TRUE(cross(x, {0, 1, 2}, {0, 3, 14}));
  EXPECT_TRUE(cross(x, {0, 1, 2}, {0, 10, 11}));
  // With a common edge: side by side, upright, and folded onto the other.
  EXPECT_FALSE(cross(x, {0, 1, 2}, {2, 1, 15}));
  EXPECT_FALSE(cross(x, {0, 1, 2}, {2, 0, 16}));
  EXPECT_FALSE(cross(x, {0, 1, 2}, {1, 0, 14}));
  EXPECT_TRUE(cross(x, {0, 1, 2}, {1, 0, 9}));
  EXPECT_TRUE(cross(x, {0, 1, 2}, {1, 0, 17}));
  // The same triangle twice.
  EXPECT_TRUE(cross(x, {0, 1, 2}, {2, 1, 0}));
}

TEST(TriangleCrossings, AgreesWithAllPairsOnRandomSoup) {
  // Definition: two triangles in general position intersect if an edge of one passes through the
  // other.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  std::vector<Vector3d> x;
  std::vector<std::array<int, 3>> triangles;
  for (int t = 0; t < 200; ++t) {
    const Vector3d center(at(random), at(random), at(random));
    for (int k = 0; k < 3; ++k)
      x.push_back(center + 0.4 * Vector3d(at(random), at(random), at(random)));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto passes = [&](int s, int t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d& p = x[3 * s + k];
      const Vector3d q = x[3 * s + (k + 1) % 3] - p;
      Eigen::Matrix3d system;
      system << x[3 * t + 1] - x[3 * t], x[3 * t + 2] - x[3 * t], -q;
      const Vector3d w = system.inverse() * (p - x[3 * t]);
      if (w[0] > 0 && w[1] > 0 && w[0] + w[1] < 1 && w[2] > 0 && w[2] < 1) return true;
    }
    return false;
  };
  std::vector<std::pair<int, int>> expected;
  for (int a = 0; a < 200; ++a)
    for (int b = a + 1; b < 200; ++b)
      if (passes(a, b) || passes(b, a)) expected.emplace_back(a, b);
  std::vector<std::pair<int, int>> found;
  for (const TriangleCrossing& c : triangleCrossings(x, triangles)) {
    found.emplace_back(c.a, c.b);
    EXPECT_TRUE(c.isThrough);
  }
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(triangleCrossings(x, triangles, 7).size(), 7U);
}

TEST(GeometryCheck, CanBeCancelledAndRefusesOtherMeshes) {
  const Solid sphere = makeSphere(25.0);
  const SurfaceMesh mesh = meshOf(sphere, 5.0);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(checkGeometry(mesh, sphere, {source.get_token(), {}}), Cancelled);
  SurfaceMesh other = mesh;
  other.patchOfTriangle[3] = 99;
  EXPECT_THROW(checkGeometry(other, sphere), std::invalid_argument);
}

}  // namespace
}  // namespace palpa::modeling
