// Measurements against exact values of boxes, spheres, cylinders and tori, as solids and as meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modeling/editing/command.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"
#include "modeling/shapes/make_primitive.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using What = MeasuredPlace::What;
using Kind = MeasurementKind;
using Fit = MeasuredValue::Fit;

constexpr double kPi = std::numbers::pi;
/// Errors by rounding, mm, for bodies of some centimetres.
constexpr double kExact = 1e-8;

MeasuredPlace point(const char* patch, double u, double v) {
  return {What::kPoint, patch, Vector2d(u, v)};
}
MeasuredPlace face(const char* patch, double u = 0.5, double v = 0.5) {
  return {What::kFace, patch, Vector2d(u, v)};
}
MeasuredPlace edge(const char* patch, Side side, double t = 0.5) {
  return {What::kEdge, patch, Vector2d(t, t), side};
}
MeasuredPlace onMesh(What what, const std::string& name, const Vector3d& at,
                     const std::string& other = {}) {
  return {what, name, at, {}, other};
}

MeasuredValue measured(const MeasuredBody& body, Kind kind, std::vector<MeasuredPlace> places) {
  return body.measure({"m", kind, std::move(places)});
}

Solid box() {
  return makePrimitive({BoxShape{{40, 30, 20}}});
}

/// Index of the mesh face that contains the point.
int faceWith(const MeshBody& body, const MeasuredBody& measured, const Vector3d& x) {
  int best = 0;
  for (int f = 0; f < static_cast<int>(body.faceNames().size()); ++f)
    if ((measured.position(measured.placeNear(f, x)) - x).norm() <
        (measured.position(measured.placeNear(best, x)) - x).norm())
      best = f;
  return best;
}

TEST(Measure, ABoxHasItsThreeSizesBetweenFaces) {
  const MeasuredBody body(box());
  const auto between = [&](const char* a, const char* b) {
    return measured(body, Kind::kDistance, {face(a, 0.3, 0.2), face(b)}).value;
  };
  EXPECT_NEAR(between("side_xmin", "side_xmax"), 40, kExact);
  EXPECT_NEAR(between("side_ymin", "side_ymax"), 30, kExact);
  EXPECT_NEAR(between("bottom", "top"), 20, kExact);
  EXPECT_NEAR(between("top", "side_xmin"), 0, kExact);  // they share an edge
}

TEST(Measure, CornersOfABoxAreTheDiagonalApart) {
  const MeasuredBody body(box());
  const MeasuredValue value = measured(
      body, Kind::kDistance, {body.placeNear(0, {-20, -15, 0}), body.placeNear(1, {20, 15, 20})});
  EXPECT_NEAR(value.value, (value.points[1] - value.points[0]).norm(), kExact);
  const auto corner = [&](const Vector3d& x) {
    MeasuredPlace best = body.placeNear(0, x);
    for (int patch = 1; patch < 6; ++patch)
      if (const auto other = body.placeNear(patch, x);
          (body.position(other) - x).norm() < (body.position(best) - x).norm())
        best = other;
    EXPECT_NEAR((body.position(best) - x).norm(), 0, kExact);
    return best;
  };
  EXPECT_NEAR(measured(body, Kind::kDistance, {corner({-20, -15, 0}), corner({20, 15, 20})}).value,
              std::sqrt(40. * 40 + 30 * 30 + 20 * 20), kExact);
}

TEST(Measure, APointIsItsHeightAboveAFaceAndAnEdge) {
  const MeasuredBody body(box());
  EXPECT_NEAR(measured(body, Kind::kDistance, {point("top", 0.5, 0.5), face("bottom")}).value, 20,
              kExact);
  // From the middle of the top to its own edges: half of the two widths.
  const double toEdge =
      measured(body, Kind::kDistance, {point("top", 0.5, 0.5), edge("top", Side::kUMin)}).value;
  EXPECT_TRUE(std::abs(toEdge - 20) < kExact || std::abs(toEdge - 15) < kExact) << toEdge;
}

TEST(Measure, AnglesOfABoxAreRightAnglesAndParallelFacesHaveNone) {
  const MeasuredBody body(box());
  const MeasuredValue corner = measured(body, Kind::kAngle, {face("top"), face("side_xmin")});
  EXPECT_NEAR(corner.value, kPi / 2, 1e-9);
  ASSERT_EQ(corner.points.size(), 3u);
  EXPECT_NEAR(corner.points[0].x(), -20, kExact);  // the common edge
  EXPECT_NEAR(corner.points[0].z(), 20, kExact);
  const MeasuredValue parallel = measured(body, Kind::kAngle, {face("top"), face("bottom")});
  EXPECT_NEAR(parallel.value, 0, 1e-9);
  EXPECT_EQ(parallel.points.size(), 2u);
  EXPECT_NEAR(
      measured(body, Kind::kAngle, {edge("top", Side::kUMin), edge("top", Side::kVMin)}).value,
      kPi / 2, 1e-9);
  EXPECT_NEAR(measured(body, Kind::kAngle, {edge("top", Side::kUMin), face("top")}).value, 0, 1e-9);
  // At a corner of the top between two of its other corners.
  EXPECT_NEAR(
      measured(body, Kind::kAngle, {point("top", 1, 0), point("top", 0, 0), point("top", 0, 1)})
          .value,
      kPi / 2, 1e-9);
}

TEST(Measure, EdgesOfABoxHaveItsSizes) {
  const MeasuredBody body(box());
  const double a = measured(body, Kind::kLength, {edge("top", Side::kUMin)}).value;
  const double b = measured(body, Kind::kLength, {edge("top", Side::kVMin)}).value;
  EXPECT_NEAR(a + b, 70, kExact);
  EXPECT_NEAR(std::abs(a - b), 10, kExact);
  EXPECT_FALSE(measured(body, Kind::kLength, {edge("top", Side::kUMin)}).second);
}

TEST(Measure, WallOfABoxIsItsHeightAndTheBallTouchesTheNearestFaces) {
  const MeasuredBody body(box());
  const MeasuredValue middle = measured(body, Kind::kThickness, {point("top", 0.5, 0.5)});
  EXPECT_NEAR(middle.value, 20, kExact);
  EXPECT_NEAR(middle.second.value(), 20, 1e-6);
  // 4 mm and 3 mm from the sides: the ball touches the nearer side, so its diameter is twice 3 mm.
  const MeasuredValue corner = measured(body, Kind::kThickness, {point("top", 0.1, 0.1)});
  EXPECT_NEAR(corner.value, 20, kExact);
  EXPECT_NEAR(corner.second.value(), 6, 1e-6);
}

TEST(Measure, AFlatFaceHasNoRadius) {
  const MeasuredBody body(box());
  const MeasuredValue value = measured(body, Kind::kRadius, {point("top", 0.3, 0.6)});
  EXPECT_TRUE(std::isinf(value.value));
  EXPECT_EQ(value.points.size(), 1u);
  EXPECT_TRUE(std::isinf(measured(body, Kind::kRadius, {edge("top", Side::kUMin)}).value));
}

/// Solids approximate round shapes; second derivatives of the approximation are this much worse
/// than its positions (orders h^4 and h^2 of cubics).
struct Round {
  Primitive primitive;
  double deviation;
  explicit Round(Primitive p) : primitive(p), deviation(makeMeasuredPrimitive(p).deviation) {}
};

TEST(Measure, ASphereIsAsThickAsItsDiameterWithItsRadiusEverywhere) {
  const Round sphere({SphereShape{25}, 3, 14});
  const MeasuredBody body(makePrimitive(sphere.primitive));
  for (const double u : {0.5, 0.2, 0.93}) {
    const MeasuredValue wall = measured(body, Kind::kThickness, {point("top", u, 0.4)});
    // The ray along an approximate normal misses the centre a little.
    EXPECT_NEAR(wall.value, 50, 0.01);
    // The ball is as small as the strongest curvature beside the place.
    EXPECT_NEAR(wall.second.value(), 50, 0.2);
    const MeasuredValue radius = measured(body, Kind::kRadius, {point("top", u, 0.4)});
    EXPECT_NEAR(radius.value, 25, 0.1);  // positive: convex
    EXPECT_NEAR(radius.second.value(), 25, 0.1);
    EXPECT_NEAR((radius.points[1]).norm(), 0, 0.1);  // the centre
  }
  // Beside an edge, where two approximations meet with a slight kink.
  for (const double u : {1e-6, 1e-3, 1.0})
    EXPECT_NEAR(measured(body, Kind::kThickness, {point("top", u, 0.4)}).second.value(), 50, 0.5);
  // Opposite patches are nearest at the corners of the cube of patches: 2 r / √3.
  EXPECT_NEAR(measured(body, Kind::kDistance, {face("top"), face("bottom")}).value,
              50 / std::sqrt(3.0), 10 * sphere.deviation + 0.01);
}

TEST(Measure, ATorusHasItsTwoRadiiInsideAndOutside) {
  const MeasuredBody body(makePrimitive({TorusShape{25, 8}, 3, 14}));
  const auto at = [&](const Vector3d& x) {
    MeasuredPlace best = body.placeNear(0, x);
    const auto count = makePrimitive({TorusShape{25, 8}, 3, 14}).patches().size();
    for (int patch = 1; patch < static_cast<int>(count); ++patch)
      if (const auto other = body.placeNear(patch, x);
          (body.position(other) - x).norm() < (body.position(best) - x).norm())
        best = other;
    return best;
  };
  const MeasuredValue outside = measured(body, Kind::kRadius, {at({33, 0, 0})});
  EXPECT_NEAR(outside.value, 8, 0.1);
  EXPECT_NEAR(outside.second.value(), 33, 0.3);
  const MeasuredValue inside = measured(body, Kind::kRadius, {at({0, 17, 0})});
  EXPECT_NEAR(inside.value, 8, 0.1);
  EXPECT_NEAR(inside.second.value(), -17, 0.3);  // hollow around the hole
  EXPECT_NEAR(measured(body, Kind::kThickness, {at({33, 0, 0})}).value, 16, 0.01);
  EXPECT_NEAR(measured(body, Kind::kThickness, {at({33, 0, 0})}).second.value(), 16, 0.05);
}

TEST(Measure, ACylinderHasARoundRimAndAFlatDirection) {
  const MeasuredBody body(makePrimitive({CylinderShape{15, 40}, 3, 14}));
  const Solid solid = makePrimitive({CylinderShape{15, 40}, 3, 14});
  const int top = solid.findPatch("top").value();
  const MeasuredPlace rim = body.edgeNear(top, {15, 0.3, 40}).value();
  const MeasuredValue length = measured(body, Kind::kLength, {rim});
  EXPECT_NEAR(length.value, 2 * kPi * 15 / 4, 0.01);  // four patches around
  EXPECT_NEAR(length.second.value(), 2 * kPi * 15, 0.01);
  const MeasuredValue radius = measured(body, Kind::kRadius, {rim});
  EXPECT_NEAR(radius.value, 15, 0.05);
  EXPECT_NEAR((radius.points[1] - Vector3d(0, 0, 40)).norm(), 0, 0.05);
  const int side = top == 0 ? 1 : 0;
  const Vector3d middle(15 * std::cos(0.4), 15 * std::sin(0.4), 17);
  MeasuredPlace on = body.placeNear(side, middle);
  for (int patch = 0; patch < static_cast<int>(solid.patches().size()); ++patch)
    if (const auto other = body.placeNear(patch, middle);
        (body.position(other) - middle).norm() < (body.position(on) - middle).norm())
      on = other;
  const MeasuredValue wall = measured(body, Kind::kRadius, {on});
  EXPECT_NEAR(wall.value, 15, 0.05);
  EXPECT_GT(std::abs(wall.second.value()), 1e6);
}

TEST(Measure, MeshOfABoxHasTheSameSizes) {
  const MeshBody mesh = test::bodyOf(box(), 6);
  const MeasuredBody body(mesh);
  EXPECT_NEAR(measured(body, Kind::kDistance,
                       {onMesh(What::kFace, "side_xmin", {-20, 0, 10}),
                        onMesh(What::kFace, "side_xmax", {20, 0, 10})})
                  .value,
              40, kExact);
  EXPECT_NEAR(measured(body, Kind::kAngle,
                       {onMesh(What::kFace, "top", {0, 0, 20}),
                        onMesh(What::kFace, "side_xmin", {-20, 0, 10})})
                  .value,
              kPi / 2, 1e-9);
  const auto top = mesh.findFace("top").value();
  const MeasuredPlace rim = body.edgeNear(top, {-20, 1, 20}).value();
  EXPECT_NEAR(measured(body, Kind::kLength, {rim}).value, 30, kExact);
  const MeasuredValue wall =
      measured(body, Kind::kThickness, {onMesh(What::kPoint, "top", {-16, -12, 20})});
  EXPECT_NEAR(wall.value, 20, kExact);
  EXPECT_NEAR(wall.second.value(), 6, 1e-6);
  EXPECT_TRUE(
      std::isinf(measured(body, Kind::kRadius, {onMesh(What::kPoint, "top", {0, 0, 20})}).value));
}

TEST(Measure, MeshOfASphereHasTheSpheresRadiusBecauseItsVerticesLieOnIt) {
  const MeshBody mesh = test::icosphere(25, 3);
  const MeasuredBody body(mesh);
  const MeasuredPlace place = body.placeNear(0, {10, 20, 12});
  const MeasuredValue radius = measured(body, Kind::kRadius, {place});
  EXPECT_EQ(radius.fit, Fit::kSphere);
  EXPECT_NEAR(radius.value, 25, 1e-9);
  EXPECT_LT(radius.accuracy, 1e-9);
  // Facets lie inside by up to 1 − cos(half an edge's angle), 0.5 % here.
  EXPECT_NEAR(measured(body, Kind::kThickness, {place}).value, 50, 0.3);
  EXPECT_NEAR(measured(body, Kind::kThickness, {place}).second.value(), 50, 0.6);
}

TEST(Measure, MeshOfABoreHasItsWallAndItsRadiiWithSigns) {
  const MeshBody mesh = test::boredCylinder(20, 12, 30, 48);
  const MeasuredBody body(mesh);
  const double h = std::cos(kPi / 48);  // to the middle of a facet
  const Vector3d outside(20 * h * std::cos(kPi / 48), 20 * h * std::sin(kPi / 48), 14);
  const int face = faceWith(mesh, body, outside);
  const MeasuredPlace place = body.placeNear(face, outside);
  EXPECT_NEAR(measured(body, Kind::kThickness, {place}).value, 8 * h, 1e-6);
  EXPECT_NEAR(measured(body, Kind::kThickness, {place}).second.value(), 8 * h, 0.01);
  if (mesh.faceNames().size() > 1) {
    const MeasuredValue radius = measured(body, Kind::kRadius, {place});
    EXPECT_EQ(radius.fit, Fit::kCylinder);
    EXPECT_NEAR(radius.value, 20, 1e-9);
    EXPECT_TRUE(std::isinf(radius.second.value()));
  }
}

TEST(Measure, MeshOfACylinderHasARoundEdge) {
  const MeshBody mesh = test::bodyOf(makePrimitive({CylinderShape{15, 40}, 3, 14}), 2);
  const MeasuredBody body(mesh);
  const MeasuredPlace rim = body.edgeNear(mesh.findFace("top").value(), {15, 0.2, 40}).value();
  const MeasuredValue radius = measured(body, Kind::kRadius, {rim});
  EXPECT_EQ(radius.fit, Fit::kCircle);
  EXPECT_NEAR(radius.value, 15, 0.01);
}

TEST(Measure, MeshOfATorusIsFittedByAPolynomialWithItsError) {
  const MeshBody mesh = test::torus(25, 8, 96, 40);
  const MeasuredBody body(mesh);
  const MeasuredValue outside =
      measured(body, Kind::kRadius, {body.placeNear(0, Vector3d(33, 0, 0))});
  EXPECT_EQ(outside.fit, Fit::kPolynomial);
  EXPECT_NEAR(outside.value, 8, 0.1);
  EXPECT_LT(std::abs(outside.value - 8), outside.accuracy);  // it says so
  EXPECT_NEAR(outside.second.value(), 33, 0.3);
  const MeasuredValue inside =
      measured(body, Kind::kRadius, {body.placeNear(0, Vector3d(17, 0, 0))});
  EXPECT_NEAR(inside.value, 8, 0.1);
  EXPECT_NEAR(inside.second.value(), -17, 0.2);
}

TEST(Measure, PlacesFollowEditsAndSayWhenTheyAreGone) {
  Project project;
  project.body = box();
  project.measurements = {{"height", Kind::kDistance, {point("top", 0.25, 0.5), face("bottom")}},
                          {"rim", Kind::kLength, {edge("top", Side::kUMax)}}};
  const double rim = MeasuredBody(project.body).measure(project.measurements[1]).value;
  const auto height = [](const Project& p) {
    return MeasuredBody(p.body).measure(p.measurements[0]).value;
  };
  // Twice as high.
  const Project scaled = apply(TransformSolid{Scaling{{1, 1, 2}}}, project).project;
  EXPECT_NEAR(height(scaled), 40, kExact);
  // A mirror exchanges the parameters; the same edge is measured.
  const Project mirrored =
      apply(TransformSolid{MirrorPlane{{0, 0, 0}, {1, 0, 0}}}, project).project;
  EXPECT_NEAR(height(mirrored), 20, kExact);
  EXPECT_NEAR(MeasuredBody(mirrored.body).measure(mirrored.measurements[1]).value, rim, kExact);
  EXPECT_NEAR((MeasuredBody(mirrored.body).position(mirrored.measurements[0].places[0]) +
               MeasuredBody(project.body).position(project.measurements[0].places[0]))
                  .x(),
              0, kExact);
  // Names of patches.
  const Project renamed = apply(RenamePatch{"top", "lid"}, project).project;
  EXPECT_NEAR(height(renamed), 20, kExact);
  // Another shape without a patch of this name.
  const Project torus = apply(MakePrimitive{{TorusShape{}}}, project).project;
  try {
    height(torus);
    FAIL() << "the torus has no top";
  } catch (const ModelingError& error) {
    EXPECT_EQ(std::string(error.what()),
              "patch \"top\": the body has no such patch any more; measure again");
  }
}

TEST(Measure, WrongPlacesAreRefusedByName) {
  const auto refusal = [](Kind kind, std::vector<MeasuredPlace> places) -> std::string {
    try {
      checkMeasurement({"m", kind, std::move(places)}, "measurements[0]");
    } catch (const ModelingError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal(Kind::kDistance, {point("top", 0, 0)}),
            "measurements[0].places: a measurement of the kind distance needs 2 of them, found 1");
  EXPECT_EQ(refusal(Kind::kLength, {point("top", 0, 0)}),
            "measurements[0].places[0].what: a length belongs to an edge");
  EXPECT_EQ(refusal(Kind::kThickness, {face("top")}),
            "measurements[0].places[0].what: a wall thickness is measured at a point");
  EXPECT_EQ(refusal(Kind::kAngle, {point("top", 0, 0), face("top")}),
            "measurements[0].places[0].what: an angle lies between three points, or between two "
            "edges or faces");
  EXPECT_EQ(refusal(Kind::kRadius, {point("top", 0, 2)}),
            "measurements[0].places[0].uv[1]: is outside the range 0 … 1");
  EXPECT_EQ(refusal(Kind::kRadius, {edge("top", Side::kUMin)}), "");
}

}  // namespace
}  // namespace palpa::modeling
