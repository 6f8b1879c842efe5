#include "modeling/solid/tangent_continuity.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "modeling/shapes/primitives.h"
#include "modeling/solid/edge_band.h"
#include "modeling/solid/edge_curve.h"
#include "modeling/solid/knot_operations.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Solid withSmooth(const Solid& solid, const std::vector<int>& edges) {
  return makeTangent(solid.withSmoothEdges(edges, true), edges);
}

std::vector<int> edgesThatAreNotSharp(const Solid& solid) {
  const std::vector<bool> sharp = sharpEdges(solid, SurfaceEvaluator(solid));
  std::vector<int> edges;
  for (std::size_t e = 0; e < sharp.size(); ++e)
    if (!sharp[e]) edges.push_back(static_cast<int>(e));
  return edges;
}

std::vector<int> allEdges(const Solid& solid) {
  std::vector<int> edges(solid.edges().size());
  for (std::size_t e = 0; e < edges.size(); ++e) edges[e] = static_cast<int>(e);
  return edges;
}

/// Largest angle across smooth edges after each of many random moves of one point, and the largest
/// displacement of another point relative to the move.
struct Walk {
  double angle = 0.0;
  double follow = 0.0;
};

Walk randomMoves(Solid solid, double step, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-step, step);
  Walk walk;
  for (int k = 0; k < count; ++k) {
    const int index = static_cast<int>(random() % solid.controlPoints().size());
    std::vector<Vector3d> points = solid.controlPoints();
    const Vector3d move(part(random), part(random), part(random));
    points[index] += move;
    const Solid edited = solid.withControlPoints(points);
    const Solid restored = restoreTangents(solid, edited, {index});
    EXPECT_EQ(restored.controlPoints()[index], points[index]);
    for (std::size_t i = 0; i < points.size(); ++i)
      walk.follow = std::max(walk.follow, (restored.controlPoints()[i] - points[i]).norm() / step);
    walk.angle = std::max(walk.angle, largestTangentAngle(restored));
    solid = restored;
  }
  return walk;
}

TEST(TangentContinuity, MeasuresTheAngleBetweenTheNormals) {
  const Solid box = makeBox({40, 30, 20});
  for (int edge : allEdges(box)) EXPECT_NEAR(tangentAngle(box, edge), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(largestTangentAngle(box), 0.0);  // no edge is smooth

  // Compared with normals from OpenCASCADE at other points.
  const Solid sphere = makeSphere(25, 5);
  const SurfaceEvaluator surface(sphere);
  for (int e : allEdges(sphere)) {
    double largest = 0.0;
    for (int k = 0; k <= 24; ++k) {
      std::array<Vector3d, 2> normals;
      for (int use = 0; use < 2; ++use) {
        const SurfaceParameter at = onEdge(surface, sphere.edges()[e], use, k / 24.0);
        normals[use] = surface.normal(at.patch, at.u, at.v);
      }
      largest = std::max(largest, std::acos(std::min(1.0, normals[0].dot(normals[1]))));
    }
    EXPECT_NEAR(tangentAngle(sphere, e), largest, 1e-9);
  }
}

TEST(TangentContinuity, ReportsAFoldedEdge) {
  // The second row of the top is folded back over the side: the normals are opposite.
  Solid box = makeBox({40, 30, 20}).withSmoothEdges(allEdges(makeBox({40, 30, 20})), true);
  const int edge = box.edgeOf(5, Side::kUMin);
  const EdgeBand band = bandOf(box, edge);
  std::vector<Vector3d> points = box.controlPoints();
  for (int k = 0; k < band.length(); ++k)
    points[band.rows[EdgeBand::inFirst][k]] = points[band.rows[EdgeBand::inSecond][k]];
  EXPECT_NEAR(tangentAngle(box.withControlPoints(points), edge), std::numbers::pi, 1e-6);
}

TEST(TangentContinuity, QuartersOfACylinderStayExact) {
  const Solid cylinder = makeCylinder(15, 40);
  const std::vector<int> sides = edgesThatAreNotSharp(cylinder);
  ASSERT_EQ(sides.size(), 4U);
  const Solid smooth = withSmooth(cylinder, sides);
  EXPECT_LT(largestTangentAngle(smooth), 1e-9);
  const Walk walk = randomMoves(smooth, 0.8, 200);
  EXPECT_LT(walk.angle, 1e-6);
  EXPECT_LT(walk.follow, 2.0);
}

TEST(TangentContinuity, ASphereStaysSmooth) {
  // Three edges meet in each of the eight corners, so this is an approximation; the sphere of this
  // net itself has angles of 0.01 rad.
  const Solid sphere = makeSphere(25);
  const Solid smooth = withSmooth(sphere, edgesThatAreNotSharp(sphere));
  EXPECT_LT(largestTangentAngle(smooth), 1e-3);
  EXPECT_LT(sampledDistance(sphere, smooth), 0.1);  // for a radius of 25
  const Walk walk = randomMoves(smooth, 0.8, 200);
  EXPECT_LT(walk.angle, 5e-3);
  EXPECT_LT(walk.follow, 3.0);
}

TEST(TangentContinuity, ASharpEdgeOfABoxBecomesSmooth) {
  const Solid box = makeBox({40, 30, 20});
  EXPECT_LT(largestTangentAngle(withSmooth(box, {0})), 1e-6);
  const Solid round = withSmooth(box, allEdges(box));
  EXPECT_LT(largestTangentAngle(round), 0.02);
  EXPECT_LT(volume(SurfaceEvaluator(round)), 24000);  // corners are cut off
  EXPECT_GT(volume(SurfaceEvaluator(round)), 12000);
  const Walk walk = randomMoves(round, 0.5, 200);
  EXPECT_LT(walk.angle, 0.03);
}

TEST(TangentContinuity, FarPointsKeepTheirBits) {
  const Solid sphere = makeSphere(25, 16);
  const Solid smooth = sphere.withSmoothEdges(edgesThatAreNotSharp(sphere), true);
  // A point beside the middle of an edge: only the three rows of that edge near it may follow.
  const EdgeBand band = bandOf(smooth, 0);
  const int index = band.rows[EdgeBand::inFirst][6];
  std::vector<Vector3d> points = smooth.controlPoints();
  points[index] *= 1.05;
  const Solid restored = restoreTangents(smooth, smooth.withControlPoints(points), {index});
  std::vector<char> near(points.size(), 0);
  for (const auto& row : band.rows)
    for (int k = 2; k <= 10; ++k) near[row[k]] = 1;
  int followed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool same = restored.controlPoints()[i] == points[i];
    EXPECT_TRUE(same || near[i]) << i;
    followed += !same;
  }
  EXPECT_GT(followed, 0);
  // A point two rows away from every edge needs no correction.
  points = smooth.controlPoints();
  const int inner = smooth.patches()[0].net[5][6];
  points[inner] *= 1.05;
  EXPECT_EQ(restoreTangents(smooth, smooth.withControlPoints(points), {inner}).controlPoints(),
            points);
}

TEST(TangentContinuity, AffineMotionsNeedNoCorrection) {
  const Solid cylinder = makeCylinder(15, 40);
  const Solid smooth = withSmooth(cylinder, edgesThatAreNotSharp(cylinder));
  std::vector<Vector3d> points = smooth.controlPoints();
  Eigen::Matrix3d map;
  map << 1.2, 0.3, 0, 0, 0.9, -0.2, 0.1, 0, 1.1;
  for (Vector3d& p : points) p = map * p + Vector3d(1, 2, 3);
  const Solid moved = smooth.withControlPoints(points);
  const Solid restored = restoreTangents(smooth, moved, {});
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((restored.controlPoints()[i] - points[i]).norm(), 1e-9);
}

}  // namespace
}  // namespace palpa::modeling
