#include "modeling/solid/knot_operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "modeling/error.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/solid/weld.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Solid with irregular control points, so that no identity holds by symmetry.
Solid shaken(const Solid& solid, double size, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-size, size);
  std::vector<Vector3d> points = solid.controlPoints();
  for (Vector3d& p : points) p += Vector3d(part(random), part(random), part(random));
  return solid.withControlPoints(std::move(points));
}

std::vector<Solid> examples() {
  return {shaken(makeBox({40, 30, 20}), 1.0), shaken(makeCylinder(15, 40), 0.5),
          shaken(makeSphere(25), 0.5)};
}

double sizeOf(const Solid& solid) {
  const auto [low, high] = boundingBox(solid);
  return (high - low).norm();
}

/// Message of the error of a call; empty if it succeeds.
template <class Call>
std::string faultOf(Call call) {
  try {
    call();
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "";
}

/// Names, edges and smooth flags must be preserved.
void expectSameTopology(const Solid& a, const Solid& b) {
  ASSERT_EQ(a.patches().size(), b.patches().size());
  for (std::size_t p = 0; p < a.patches().size(); ++p)
    EXPECT_EQ(a.patches()[p].name, b.patches()[p].name);
  ASSERT_EQ(a.edges().size(), b.edges().size());
  for (std::size_t e = 0; e < a.edges().size(); ++e) {
    EXPECT_EQ(a.edges()[e].smooth, b.edges()[e].smooth);
    EXPECT_EQ(a.edges()[e].uses[0].patch, b.edges()[e].uses[0].patch);
    EXPECT_EQ(a.edges()[e].uses[0].side, b.edges()[e].uses[0].side);
  }
}

TEST(KnotOperations, AChainGoesAroundTheSolid) {
  const Solid box = makeBox({40, 30, 20});
  for (int patch = 0; patch < 6; ++patch)
    for (int direction = 0; direction < 2; ++direction)
      EXPECT_EQ(chainOf(box, {patch, direction}).size(), 4U);
  // Each of the three strips of a cube is found from any of its patches.
  const auto chain = chainOf(box, {0, 0});
  for (const ChainLink& link : chain) EXPECT_EQ(chainOf(box, link.at).size(), chain.size());
}

TEST(KnotOperations, InsertionKeepsTheShape) {
  for (Solid solid : examples()) {
    solid = solid.withSmoothEdges({1, 3}, true);
    for (double at : {0.5, 0.123, 0.75}) {
      const Solid refined = insertKnot(solid, {1, 1}, at, 2);
      EXPECT_LT(sampledDistance(solid, refined), 1e-12 * sizeOf(solid));
      EXPECT_LT(sampledDistance(refined, solid), 1e-12 * sizeOf(solid));
      EXPECT_EQ(refined.patches()[1].net[0].size(), solid.patches()[1].net[0].size() + 2);
      expectSameTopology(solid, refined);
    }
  }
}

TEST(KnotOperations, InsertionAddsOneRowAndSharesIt) {
  // A strip of four patches of a box with 4 x 4 points each: the closed row around it has 4 patches
  // x 3 points; the other direction of the patches has 4 points, none of which is new.
  const Solid box = makeBox({40, 30, 20});
  ASSERT_EQ(box.controlPoints().size(), 56U);
  EXPECT_EQ(insertKnot(box, {0, 0}, 0.5).controlPoints().size(), 56U + 12U);
}

TEST(KnotOperations, InsertionFollowsReversedAndRescaledParameters) {
  const Solid box = makeBox({40, 30, 20});
  std::vector<Patch> patches = box.patches();
  for (double& knot : patches[1].knots[0]) knot = 3.0 + 7.0 * knot;
  for (double& knot : patches[5].knots[1]) knot = -1.0 + 0.1 * knot;
  const Solid scaled = shaken(Solid(box.controlPoints(), patches), 1.0);
  for (int patch = 0; patch < 6; ++patch)
    for (int direction = 0; direction < 2; ++direction) {
      const auto [low, high] = scaled.patches()[patch].range(direction);
      const Solid refined = insertKnot(scaled, {patch, direction}, low + 0.3 * (high - low));
      EXPECT_LT(sampledDistance(scaled, refined), 1e-12 * sizeOf(scaled));
      for (const ChainLink& link : chainOf(scaled, {patch, direction})) {
        const Patch& other = refined.patches()[link.at.patch];
        const auto range = other.range(link.at.direction);
        const double part = (other.knots[link.at.direction][4] - range[0]) / (range[1] - range[0]);
        EXPECT_NEAR(part, link.reversed ? 0.7 : 0.3, 1e-12);
      }
    }
}

TEST(KnotOperations, ManyKnotsAtOnceEqualSingleInsertions) {
  const std::vector<double> parameters{0.8, 0.1, 0.3, 0.6};
  for (const Solid& solid : examples())
    for (int direction = 0; direction < 2; ++direction) {
      Solid oneByOne = solid;
      for (double at : parameters) oneByOne = insertKnot(oneByOne, {1, direction}, at);
      const Solid atOnce = insertKnots(solid, {1, direction}, parameters);
      expectSameTopology(solid, atOnce);
      ASSERT_EQ(atOnce.controlPoints().size(), oneByOne.controlPoints().size());
      for (std::size_t p = 0; p < solid.patches().size(); ++p)
        EXPECT_EQ(atOnce.patches()[p].net, oneByOne.patches()[p].net);
      for (std::size_t k = 0; k < atOnce.controlPoints().size(); ++k)
        EXPECT_LT((atOnce.controlPoints()[k] - oneByOne.controlPoints()[k]).norm(),
                  1e-12 * sizeOf(solid));
    }
  const Solid box = makeBox({40, 30, 20});
  EXPECT_EQ(insertKnots(box, {0, 0}, {}).controlPoints().size(), box.controlPoints().size());
  EXPECT_EQ(faultOf([&] {
              insertKnots(box, {0, 0}, {0.5, 0.5 + 1e-8});
            }).find("at: 0.5 and 0.50000001 are too close to each other in u of patch"),
            0U);
  const Solid once = insertKnot(box, {0, 0}, 0.5);
  EXPECT_EQ(faultOf([&] {
              insertKnots(once, {0, 0}, {0.3, 0.5});
            }).find("at: 0.5 is already a knot of u of patch"),
            0U);
  EXPECT_EQ(faultOf([&] { insertKnots(box, {0, 0}, {1.5}); }).find("at: 1.5 is not inside"), 0U);
}

TEST(KnotOperations, AnInsertedKnotCanBeRemovedAgain) {
  for (const Solid& solid : examples()) {
    const Solid refined = insertKnot(solid, {2, 0}, 0.4);
    const KnotRemoval removed = removeKnot(refined, {2, 0}, 0.4, 1, 1e-9);
    EXPECT_LT(removed.deviation, 1e-11 * sizeOf(solid));
    ASSERT_EQ(removed.solid.controlPoints().size(), solid.controlPoints().size());
    EXPECT_LT(sampledDistance(solid, removed.solid), 1e-11 * sizeOf(solid));
    expectSameTopology(solid, removed.solid);
  }
}

TEST(KnotOperations, RemovalStatesItsDeviationAndRefusesBeyondTheTolerance) {
  const Solid sphere = makeSphere(25);
  const KnotRemoval removed = removeKnot(sphere, {0, 0}, 0.5, 1, 1.0);
  EXPECT_GT(removed.deviation, 1e-4);
  EXPECT_LT(removed.deviation, 0.1);
  EXPECT_NEAR(sampledDistance(sphere, removed.solid), removed.deviation, 1e-12);
  const std::string fault = faultOf([&] { removeKnot(sphere, {0, 0}, 0.5, 1, 1e-4); });
  EXPECT_EQ(fault.rfind("tolerance_mm: without the knot 0.5 of u of patch \"side_xmin\"", 0), 0U)
      << fault;
}

TEST(KnotOperations, ElevationKeepsTheShape) {
  for (Solid solid : examples())
    for (int degree : {4, 5}) {
      const Solid raised = elevateDegree(solid, {0, 1}, degree);
      EXPECT_EQ(raised.patches()[0].degree[1], degree);
      EXPECT_LT(sampledDistance(solid, raised), 1e-12 * sizeOf(solid));
      EXPECT_NEAR(volume(SurfaceEvaluator(raised)), volume(SurfaceEvaluator(solid)),
                  1e-9 * volume(SurfaceEvaluator(solid)));
      expectSameTopology(solid, raised);
    }
}

TEST(KnotOperations, FarPatchesKeepTheirPoints) {
  // The strip of (0, 0) omits two patches; their inner points, and the edges along the other
  // direction, keep their values.
  const Solid box = shaken(makeBox({40, 30, 20}), 1.0);
  const Solid refined = insertKnot(box, {0, 0}, 0.5);
  std::vector<char> inChain(6, 0);
  for (const ChainLink& link : chainOf(box, {0, 0})) inChain[link.at.patch] = 1;
  for (int p = 0; p < 6; ++p) {
    if (inChain[p]) continue;
    for (int i = 1; i < 3; ++i)
      for (int j = 1; j < 3; ++j)
        EXPECT_EQ(box.controlPoints()[box.patches()[p].net[i][j]],
                  refined.controlPoints()[refined.patches()[p].net[i][j]]);
  }
  EXPECT_EQ(std::count(inChain.begin(), inChain.end(), 0), 2);
}

TEST(KnotOperations, RefusesImpossibleOperations) {
  const Solid box = makeBox({40, 30, 20});
  const auto begins = [](const std::string& text, const std::string& start) {
    EXPECT_EQ(text.rfind(start, 0), 0U) << text;
  };
  begins(faultOf([&] {
           insertKnot(box, {5, 0}, 0.0);
         }),
         "at: 0 is not inside the range of u of patch \"top\" (0 … 1)");
  begins(faultOf([&] { insertKnot(box, {5, 1}, std::nan("")); }), "at: nan is not inside");
  begins(faultOf([&] { insertKnot(box, {5, 1}, 0.5, 4); }), "times: 4 is outside 1 … 3");
  begins(faultOf([&] { insertKnot(box, {5, 1}, 0.5, 0); }), "times: 0 is outside 1 … 3");
  const Solid refined = insertKnot(box, {5, 1}, 0.5, 2);
  begins(faultOf([&] {
           insertKnot(refined, {5, 1}, 0.5, 2);
         }),
         "at: the knot 0.5 occurs 2 times in v of patch \"top\"; with degree 3");
  begins(faultOf([&] { insertKnot(refined, {5, 1}, 0.5 + 1e-7); }), "at: 0.5000001 is too close");
  EXPECT_EQ(insertKnot(refined, {5, 1}, 0.5 + 1e-12).patches()[5].knots[1][6], 0.5);
  begins(faultOf([&] {
           removeKnot(box, {5, 1}, 0.5, 1, 1.0);
         }),
         "at: 0.5 is not a knot of v of patch \"top\", which has no inner knots");
  begins(faultOf([&] {
           removeKnot(refined, {5, 1}, 0.4, 1, 1.0);
         }),
         "at: 0.4 is not a knot of v of patch \"top\"; the inner knots are 0.5");
  begins(faultOf([&] {
           removeKnot(refined, {5, 1}, 0.5, 3, 1.0);
         }),
         "times: 3, but the knot 0.5 occurs 2 times");
  begins(faultOf([&] {
           elevateDegree(box, {5, 1}, 3);
         }),
         "degree: 3; v of patch \"top\" has degree 3 and can be raised to at most 5");
  begins(faultOf([&] { elevateDegree(box, {5, 1}, 6); }), "degree: 6;");
}

TEST(KnotOperations, TheFastVolumeEqualsTheVolumeOfTheSurface) {
  for (const Solid& solid : examples()) {
    const Solid raised = insertKnot(elevateDegree(solid, {3, 0}, 5), {3, 1}, 0.3, 3);
    const double expected = volume(SurfaceEvaluator(raised));
    EXPECT_NEAR(volume(raised.controlPoints(), raised.patches()), expected, 1e-12 * expected);
  }
}

}  // namespace
}  // namespace palpa::modeling
