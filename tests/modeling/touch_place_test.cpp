// The place of a first touch.
#include "modeling/project/touch_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeling/error.h"
#include "modeling/mesh/surface_boolean.h"
#include "modeling/project/proposed_support.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Support holding(std::vector<std::string> patches) {
  Support support;
  support.where = Region::ofPatches(std::move(patches));
  return support;
}

void expectNear(const Vector3d& found, const Vector3d& expected, double tolerance) {
  EXPECT_LT((found - expected).norm(), tolerance)
      << found.transpose() << " instead of " << expected.transpose();
}

TEST(TouchPlace, IsTheMiddleOfTheFaceOppositeToTheHeldOne) {
  const Vector3d size(40, 30, 20);
  for (const Body& body : {Body(makeBox(size)), Body(test::bodyOf(makeBox(size), 6))}) {
    const TouchPlace top = placeOppositeToSupports(body, {holding({"bottom"})}, 5);
    EXPECT_NEAR(top.position.z(), 20, 1e-9);
    expectNear(top.position, {0, 0, 20}, 1);
    expectNear(top.normal, Vector3d::UnitZ(), 1e-9);
    EXPECT_EQ(top.radius, 5);
    const TouchPlace side = placeOppositeToSupports(body, {holding({"side_xmax"})}, 5);
    EXPECT_NEAR(side.position.x(), -20, 1e-9);
    expectNear(side.normal, -Vector3d::UnitX(), 1e-9);
  }
}

TEST(TouchPlace, IsTheFarPoleOfASphere) {
  for (const Body& body : {Body(makeSphere(25)), Body(test::icosphere(25, 4))}) {
    const TouchPlace place = placeOppositeToSupports(body, {supportOfLowestTenth(body)}, 5);
    expectNear(place.position, {0, 0, 25}, 3);
    EXPECT_GT(place.normal.z(), 0.98);
    EXPECT_EQ(place.radius, 5);
  }
}

TEST(TouchPlace, AvoidsTheEdgeOfAHoleAndTheTipOfACone) {
  const MeshBody tube = test::boredCylinder(20, 8, 25, 48);
  const TouchPlace ring = placeOppositeToSupports(tube, {supportOfLowestTenth(tube)}, 5);
  EXPECT_NEAR(ring.position.z(), 25, 1e-9);
  EXPECT_NEAR(ring.position.head<2>().norm(), 14, 1) << "the middle of the rim";

  // A four-sided pyramid with many triangles at its tip is sharp there.
  std::vector<Vector3d> positions{{0, 0, 30}, {0, 0, 0}};
  std::vector<std::array<int, 3>> triangles;
  constexpr int kSides = 24;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    positions.push_back({10 * std::cos(angle), 10 * std::sin(angle), 0});
  }
  for (int i = 0; i < kSides; ++i) {
    triangles.push_back({0, 2 + i, 2 + (i + 1) % kSides});
    triangles.push_back({1, 2 + (i + 1) % kSides, 2 + i});
  }
  const MeshBody cone = test::oneFace(positions, triangles);
  Support base;
  base.where = Region::below(Vector3d::UnitZ(), 1.0);
  const TouchPlace flank = placeOppositeToSupports(cone, {base}, 5);
  EXPECT_GE((flank.position - Vector3d(0, 0, 30)).norm(), 5);
  EXPECT_GT(flank.position.z(), 15) << "the upper half";
}

TEST(TouchPlace, UsesASmallerRadiusOnASlenderTop) {
  // No place of a top 2 mm wide is farther than 1 mm from an edge.
  const TouchPlace place = placeOppositeToSupports(makeBox({2, 2, 30}), {holding({"bottom"})}, 3);
  expectNear(place.position, {0, 0, 30}, 0.3);
  EXPECT_LE(place.radius, 1.0);
  EXPECT_GE(place.radius, 0.75);
}

TEST(TouchPlace, IsFarFromSupportsThatSurroundTheBody) {
  const Body box = makeBox({40, 30, 20});
  const TouchPlace place = placeOppositeToSupports(
      box, {holding({"side_xmin", "side_xmax"}), holding({"side_ymin", "side_ymax"})}, 4);
  EXPECT_NEAR(std::abs(place.position.z() - 10), 10, 1e-9);
  EXPECT_NEAR(place.position.y(), 0, 0.5);
}

TEST(TouchPlace, FindsASupportSmallerThanTheTrianglesOfTheBody) {
  Support spot;
  spot.where.parts = {Stroke{{{20, 15, 0}}, 0.01}};
  const TouchPlace place = placeOppositeToSupports(test::plainBox({40, 30, 20}), {spot}, 4);
  EXPECT_NEAR(place.position.z(), 20, 1e-9);
}

TEST(TouchPlace, IsTheSameAtEveryCallAndMovesWithTheBody) {
  const Body box = makeBox({40, 30, 20});
  const std::vector<Support> supports{holding({"bottom"})};
  const TouchPlace once = placeOppositeToSupports(box, supports, 4);
  EXPECT_EQ(placeOppositeToSupports(box, supports, 4).position, once.position);
}

// A pin is higher than the top of its block, but narrower than the touch.
TEST(TouchPlace, IsNotOnAThinPinBesideAWideFace) {
  const auto surfaceOf = [](const MeshBody& body) {
    return FacedTriangles{body.positions(), body.triangles(), body.faceOfTriangle()};
  };
  const FacedTriangles block = surfaceOf(test::plainBox({8, 8, 8.2}));
  FacedTriangles pin = surfaceOf(test::bodyOf(makeCylinder(0.4, 20), 0.3));
  const double top =
      std::max_element(block.positions.begin(), block.positions.end(),
                       [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); })
          ->z();
  for (Vector3d& x : pin.positions) x = Vector3d(x.z() + 7.5, x.y() + 4, -x.x() + top - 0.2);
  const auto both = unionOf(block, pin);
  ASSERT_TRUE(both);
  MeshBody::Data data{both->positions, both->triangles, {}, {"all"}};
  data.faceOfTriangle.assign(both->triangles.size(), 0);
  const Body body = MeshBody(std::move(data));
  const std::vector<Support> supports{supportOfLowestTenth(body)};
  EXPECT_NEAR(placeOppositeToSupports(body, supports, 2).position.z(), top, 1e-9);
  // A touch as narrow as the pin takes the highest place.
  EXPECT_GT(placeOppositeToSupports(body, supports, 0.3).position.z(), top + 0.1);
}

TEST(TouchPlace, SaysThatThereIsNoSupportOrNoFreePlace) {
  const Body box = makeBox({40, 30, 20});
  EXPECT_THROW(placeOppositeToSupports(box, {}, 4), ModelingError);
  try {
    placeOppositeToSupports(box, {holding(patchNames(box))}, 4);
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_NE(std::string(error.what()).find("whole surface"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace palpa::modeling
