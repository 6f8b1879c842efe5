// Shapes with formulas: their volumes, their fit, and the marks of their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "modeling/project/project_file.h"
#include "modeling/solid/surface_properties.h"
#include "shape_checks.h"

namespace palpa::modeling {
namespace {

using checks::cubic;
using checks::edgeAngles;
using checks::polyline;
using checks::refusal;
using checks::roundCurve;

constexpr double kPi = std::numbers::pi;

struct Case {
  const char* name;
  Primitive primitive;
  double volume;
  double area;  ///< 0: no closed formula
  int patches;
  int smoothEdges;
  double size;  ///< mm: reference length for deviations
};

double ellipsoidVolume(double a, double b, double c) {
  return 4.0 / 3.0 * kPi * a * b * c;
}

double frustumVolume(double a, double b, double h) {
  return kPi * h / 3.0 * (a * a + a * b + b * b);
}

double frustumArea(double a, double b, double h) {
  return kPi * (a * a + b * b + (a + b) * std::hypot(h, a - b));
}

std::vector<Case> cases() {
  return {
      {"box", {BoxShape{{40, 30, 20}}}, 24000, 5200, 6, 0, 40},
      {"sphere", {SphereShape{25}}, ellipsoidVolume(25, 25, 25), 4 * kPi * 625, 6, 12, 25},
      {"ellipsoid", {EllipsoidShape{{30, 20, 15}}}, ellipsoidVolume(30, 20, 15), 0, 6, 12, 30},
      {"cylinder", {CylinderShape{15, 40}}, kPi * 9000, kPi * (450 + 1200), 6, 4, 15},
      {"frustum",
       {ConeShape{20, 10, 30}},
       frustumVolume(20, 10, 30),
       frustumArea(20, 10, 30),
       6,
       4,
       20},
      {"cone", {ConeShape{20, 0, 30}}, frustumVolume(20, 0, 30), frustumArea(20, 0, 30), 8, 8, 20},
      {"capsule",
       {CapsuleShape{10, 30}},
       ellipsoidVolume(10, 10, 10) + kPi * 3000,
       4 * kPi * 100 + 2 * kPi * 300,
       14,
       28,
       10},
      {"torus", {TorusShape{25, 8}}, 2 * kPi * kPi * 25 * 64, 4 * kPi * kPi * 25 * 8, 16, 32, 8},
      // The same bodies from profiles.
      {"revolved cone",
       {RevolveShape{polyline({{20, 0}, {0, 30}})}},
       frustumVolume(20, 0, 30),
       frustumArea(20, 0, 30),
       8,
       8,
       20},
      {"revolved frustum",
       {RevolveShape{polyline({{20, 0}, {10, 30}})}},
       frustumVolume(20, 10, 30),
       frustumArea(20, 10, 30),
       6,
       4,
       20},
      {"revolved cylinder, closed at the axis",
       {RevolveShape{polyline({{0, 0}, {15, 0}, {15, 40}, {0, 40}})}},
       kPi * 9000,
       kPi * (450 + 1200),
       6,
       4,
       15},
      {"tube",
       {RevolveShape{polyline({{10, 0}, {20, 0}, {20, 30}, {10, 30}, {10, 0}})}},
       kPi * 9000,
       2 * kPi * 300 + 2 * kPi * 900,
       16,
       16,
       20},
      {"double cone",
       {RevolveShape{polyline({{0, -10}, {20, 0}, {0, 30}})}},
       frustumVolume(20, 0, 40),
       kPi * 20 * (std::hypot(20, 10) + std::hypot(20, 30)),
       8,
       8,
       20},
      {"prism on a triangle",
       {ExtrudeShape{polyline({{0, 0}, {30, 0}, {0, 40}, {0, 0}}), 20}},
       12000,
       1200 + 20 * 120,
       6,
       1,
       40},
      {"prism on an L",
       {ExtrudeShape{polyline({{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}, {0, 0}}),
                     20}},
       10000,
       1000 + 20 * 120,
       10,
       2,
       30},
      {"frustum of a pyramid",
       {LoftShape{{{0, polyline({{-6, -6}, {6, -6}, {6, 6}, {-6, 6}, {-6, -6}})},
                   {9, polyline({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}})}}}},
       9.0 / 3.0 * (144 + 36 + 72),
       144 + 36 + 4 * 9 * std::hypot(9, 3),
       6,
       0,
       12},
  };
}

TEST(Shapes, HaveTheVolumeAndAreaOfTheirFormulas) {
  for (const Case& c : cases()) {
    const MadeSolid made = makeMeasuredPrimitive(c.primitive);
    const SurfaceEvaluator surface(made.solid);
    // A surface displaced by at most the deviation encloses a volume that differs by at most area
    // times deviation.
    EXPECT_NEAR(volume(surface), c.volume, 1.05 * area(surface) * made.deviation + 1e-9 * c.volume)
        << c.name;
    if (c.area > 0.0) {
      EXPECT_NEAR(area(surface) / c.area, 1.0, 2e-3) << c.name;
    }
  }
}

TEST(Shapes, DeviateByLessThanAThousandthByDefault) {
  for (const Case& c : cases())
    EXPECT_LE(makeMeasuredPrimitive(c.primitive).deviation, 1e-3 * c.size) << c.name;
}

TEST(Shapes, AreCutIntoTheStatedPatchesAndMarkTheirSmoothEdges) {
  for (const Case& c : cases()) {
    const Solid solid = makePrimitive(c.primitive);
    EXPECT_EQ(static_cast<int>(solid.patches().size()), c.patches) << c.name;
    EXPECT_EQ(std::count_if(solid.edges().begin(), solid.edges().end(),
                            [](const SolidEdge& edge) { return edge.smooth; }),
              c.smoothEdges)
        << c.name;
  }
}

TEST(Shapes, NormalsAgreeAcrossSmoothEdgesAndNotAcrossSharpOnes) {
  for (const Case& c : cases()) {
    // Measured: 0.45 degrees (capsule); 1.9 at the tip of a cone, which has no tangent plane.
    const checks::EdgeAngles angles = edgeAngles(makePrimitive(c.primitive));
    const bool hasApex = std::string(c.name).find("cone") != std::string::npos;
    EXPECT_LT(angles.largestSmooth, hasApex ? 3.0 : 0.5) << c.name;
    EXPECT_GT(angles.smallestSharp, 40.0) << c.name;
  }
}

TEST(Shapes, NormalsAgreeBetterWithMoreControlPoints) {
  for (const auto& shape :
       {decltype(Primitive::shape)(SphereShape{25}), decltype(Primitive::shape)(TorusShape{25, 8}),
        decltype(Primitive::shape)(CapsuleShape{10, 30})}) {
    const double coarse = edgeAngles(makePrimitive({shape, 3, 7})).largestSmooth;
    const double fine = edgeAngles(makePrimitive({shape, 3, 11})).largestSmooth;
    EXPECT_LT(fine, coarse / 6.0) << shape.index();
  }
}

TEST(Shapes, NetsOfDegreeOneAreFacetedAndHaveNoSmoothEdges) {
  for (Case& c : cases()) {
    c.primitive.degree = 1;
    const Solid solid = makePrimitive(c.primitive);
    for (const SolidEdge& edge : solid.edges()) EXPECT_FALSE(edge.smooth) << c.name;
  }
}

TEST(Shapes, DeviationFallsWithTheOrderOfTheDegree) {
  // Spline interpolation of degree p has order p + 1. With so few spans the order of the cube
  // sphere, whose derivatives grow rapidly towards the corners of its faces, stays at about 4.
  constexpr int kSpans = 6;
  for (int degree = 1; degree <= 5; ++degree)
    for (const auto& shape : {decltype(Primitive::shape)(SphereShape{25}),
                              decltype(Primitive::shape)(TorusShape{25, 8})}) {
      const auto deviation = [&](int spans) {
        return makeMeasuredPrimitive({shape, degree, degree + spans}).deviation;
      };
      const double order = std::log2(deviation(kSpans) / deviation(2 * kSpans));
      const double expected = shape.index() == 1 ? std::min(degree + 1, 4) : degree + 1;
      EXPECT_GT(order, expected - 0.35) << "degree " << degree << " shape " << shape.index();
      EXPECT_LT(order, degree + 3) << "degree " << degree << " shape " << shape.index();
    }
}

TEST(Shapes, DeviationOfASphereIsTheDistanceFromItsRadius) {
  const MadeSolid made = makeMeasuredPrimitive({SphereShape{25}, 3, 5});
  const SurfaceEvaluator surface(made.solid);
  double worst = 0.0;
  for (int patch = 0; patch < 6; ++patch)
    for (int i = 0; i <= 120; ++i)
      for (int j = 0; j <= 120; ++j)
        worst =
            std::max(worst, std::abs(surface.position(patch, i / 120.0, j / 120.0).norm() - 25.0));
  EXPECT_GT(worst, 1e-3);
  EXPECT_NEAR(made.deviation, worst, 0.03 * worst);
}

TEST(Shapes, DeviationOfATorusIsTheDistanceFromItsCentreLine) {
  const MadeSolid made = makeMeasuredPrimitive({TorusShape{25, 8}, 2, 4});
  const SurfaceEvaluator surface(made.solid);
  double worst = 0.0;
  for (int patch = 0; patch < 16; ++patch)
    for (int i = 0; i <= 80; ++i)
      for (int j = 0; j <= 80; ++j) {
        const Eigen::Vector3d p = surface.position(patch, i / 80.0, j / 80.0);
        const double distance = std::hypot(p.head<2>().norm() - 25.0, p.z());
        worst = std::max(worst, std::abs(distance - 8.0));
      }
  EXPECT_NEAR(made.deviation, worst, 0.03 * worst);
}

TEST(Shapes, AConeIsSharpAndBetterWithMorePoints) {
  const auto deviation = [](int points) {
    return makeMeasuredPrimitive({ConeShape{20, 0, 30}, 3, points}).deviation;
  };
  EXPECT_LT(deviation(12), 0.6 * deviation(9));
  const Solid cone = makePrimitive({ConeShape{20, 0, 30}});
  const auto& points = cone.controlPoints();
  EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const Eigen::Vector3d& p) {
    return (p - Eigen::Vector3d(0, 0, 30)).norm() < 1e-12;
  }));
}

TEST(Shapes, EveryDegreeAndNetSizeMakesASolidThatMeshesWell) {
  double worst = 90.0;
  for (int degree = 1; degree <= 5; ++degree)
    for (int points : {0, 8})
      for (Case& c : cases()) {
        c.primitive.degree = degree;
        c.primitive.controlPoints = points;
        const Solid solid = makePrimitive(c.primitive);
        for (const Patch& patch : solid.patches())
          EXPECT_EQ(patch.degree, (std::array{degree, degree}));
        if (points > 0)
          for (const Patch& patch : solid.patches()) {
            EXPECT_EQ(patch.net.size(), static_cast<std::size_t>(points));
            EXPECT_EQ(patch.net.front().size(), static_cast<std::size_t>(points));
          }
        const double angle = checks::smallestMeshAngle(solid, 0.3 * c.size);
        EXPECT_GT(angle, 24.0) << c.name << " degree " << degree << " points " << points;
        worst = std::min(worst, angle);
      }
  RecordProperty("smallest_angle_degrees", std::to_string(worst));
}

TEST(Shapes, PatchNamesAreUniqueAndDescribeTheLocation) {
  const auto names = [](const Primitive& primitive) {
    std::set<std::string> result;
    const Solid solid = makePrimitive(primitive);
    for (const Patch& patch : solid.patches()) result.insert(patch.name);
    return result;
  };
  const std::set<std::string> cube{"side_xmin", "side_xmax", "side_ymin",
                                   "side_ymax", "bottom",    "top"};
  EXPECT_EQ(names({BoxShape{}}), cube);
  EXPECT_EQ(names({SphereShape{}}), cube);
  EXPECT_EQ(names({EllipsoidShape{}}), cube);
  EXPECT_EQ(names({CylinderShape{}}), cube);
  EXPECT_EQ(names({ConeShape{}}), cube);
  EXPECT_TRUE(names({ConeShape{20, 0, 30}}).contains("side_xmax_ymin"));
  EXPECT_TRUE(names({CapsuleShape{}}).contains("top_xmin"));
  EXPECT_TRUE(names({TorusShape{}}).contains("inner_ymax"));
  EXPECT_TRUE(names({ExtrudeShape{roundCurve(10, 10), 5}}).contains("side_4"));
  // A name describes the location of the patch.
  for (const Primitive& primitive :
       {Primitive{CapsuleShape{}}, Primitive{TorusShape{}}, Primitive{ConeShape{20, 0, 30}}}) {
    const Solid solid = makePrimitive(primitive);
    const SurfaceEvaluator surface(solid);
    for (std::size_t p = 0; p < solid.patches().size(); ++p) {
      const std::string& name = solid.patches()[p].name;
      const Eigen::Vector3d middle = surface.position(static_cast<int>(p), 0.5, 0.5);
      if (name.find("xmax") != std::string::npos) {
        EXPECT_GT(middle.x(), 0.0) << name;
      }
      if (name.find("ymin") != std::string::npos) {
        EXPECT_LT(middle.y(), 0.0) << name;
      }
    }
  }
}

TEST(Shapes, ExampleProjectsEqualTheirPrimitives) {
  const auto same = [](const char* file, const Primitive& primitive) {
    const Project project = readProject(std::string("data/projects/v1/") + file);
    const Solid& solid = std::get<Solid>(project.body);
    const Solid made = makePrimitive(primitive);
    ASSERT_EQ(made.controlPoints().size(), solid.controlPoints().size()) << file;
    for (std::size_t i = 0; i < made.controlPoints().size(); ++i)
      EXPECT_EQ(made.controlPoints()[i], solid.controlPoints()[i]) << file << ' ' << i;
  };
  same("sphere.json", {SphereShape{25}});
  same("cylinder.json", {CylinderShape{20, 60}});
  same("box.json", {BoxShape{{40, 30, 20}}});
}

TEST(Shapes, RefuseImpossibleParametersWithAMessage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({SphereShape{-1}}).find("sphere: the radius is -1 mm; expected 0.001"), 0U);
  EXPECT_EQ(refusal({EllipsoidShape{{1, nan, 1}}}).find("ellipsoid: the radius in y is nan"), 0U);
  EXPECT_EQ(refusal({EllipsoidShape{{1e6, 1, 1}}}),
            "ellipsoid: the radius in x is 1e+06 mm and the radius in y 1 mm; none may be more "
            "than 10000 times the other");
  EXPECT_EQ(refusal({ConeShape{0, 10, 30}}).find("cone: the bottom radius is 0 mm"), 0U);
  EXPECT_EQ(refusal({ConeShape{10, -1, 30}}).find("cone: the top radius is -1 mm"), 0U);
  EXPECT_EQ(refusal({ConeShape{10, 0, 0}}).find("cone: the height is 0 mm"), 0U);
  EXPECT_EQ(refusal({CapsuleShape{10, 0}}).find("capsule: the length is 0 mm"), 0U);
  EXPECT_EQ(refusal({TorusShape{8, 8}})
                .find("torus: the minor radius is 8 mm; it must be smaller than the major radius"),
            0U);
  EXPECT_EQ(refusal({TorusShape{1e300, 8}}).find("torus: the major radius is 1e+300 mm"), 0U);
  EXPECT_EQ(refusal({SphereShape{1}, 6}), "sphere: the degree is 6; expected 1 … 5");
  EXPECT_EQ(refusal({SphereShape{1}, 0}), "sphere: the degree is 0; expected 1 … 5");
  EXPECT_EQ(refusal({TorusShape{}, 3, 3}),
            "torus: 3 control points per direction; expected 4 … 64 for degree 3");
  EXPECT_EQ(refusal({TorusShape{}, 3, -7}).find("torus: -7 control points"), 0U);
  EXPECT_EQ(refusal({TorusShape{}, 3, 65}).find("torus: 65 control points"), 0U);
}

}  // namespace
}  // namespace palpa::modeling
