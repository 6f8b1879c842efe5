// Revolve, extrude and loft: accepted profiles, and the treatment of their corners and ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeling/error.h"
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

ProfileCurve square(double half) {
  return polyline({{-half, -half}, {half, -half}, {half, half}, {-half, half}, {-half, -half}});
}

/// Area inside a closed curve: the volume of the extruded solid over its height.
double sectionArea(const Solid& solid, double height) {
  return volume(SurfaceEvaluator(solid)) / height;
}

TEST(Profile, InvalidCurvesAreRefusedWithTheLocation) {
  const auto refused = [](ProfileCurve curve) { return refusal({ExtrudeShape{curve, 10}}); };
  ProfileCurve curve = square(5);
  curve.degree = 6;
  EXPECT_EQ(refused(curve), "extrude: profile.degree: 6; expected 1 … 5");
  curve = square(5);
  curve.points[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(curve).find("extrude: profile.points_mm[2][1]: inf is not a finite"), 0U);
  curve = square(5);
  curve.knots.pop_back();
  EXPECT_EQ(refused(curve), "extrude: profile.knots: 6 knots, but 5 points of degree 1 need 7");
  curve = square(5);
  curve.knots[3] = 0.5;
  EXPECT_EQ(refused(curve).find("extrude: profile.knots[3]: 0.5 is smaller than"), 0U);
  curve = square(5);
  curve.knots[3] = curve.knots[2];
  EXPECT_EQ(refused(curve).find("extrude: profile.knots[3]: 1 occurs more often"), 0U);
  curve = square(5);
  curve.knots.front() = -1;
  EXPECT_EQ(refused(curve).find("extrude: profile.knots[1]: 0 must equal"), 0U);
  curve = square(5);
  for (double& knot : curve.knots) knot = 0;
  EXPECT_NE(refused(curve).find("the range must not be empty"), std::string::npos);
  curve = square(5);
  curve.knots[2] = std::nan("");
  EXPECT_NE(refused(curve).find("knots[2]: nan"), std::string::npos);
  EXPECT_EQ(refused({3, {}, {}}), "extrude: profile.points_mm: 0 points; degree 3 needs 4 … 256");
  EXPECT_EQ(refused(square(1e-5)).find("extrude: profile.points_mm: all lie within"), 0U);
}

TEST(Profile, CurvesWithCrossingsOrCoincidentPointsAreRefused) {
  const auto refused = [](const ProfileCurve& curve) { return refusal({ExtrudeShape{curve, 10}}); };
  const auto figureEight = polyline({{0, 0}, {10, 10}, {10, 0}, {0, 10}, {0, 0}});
  EXPECT_EQ(refused(figureEight).find("extrude: profile: the curve crosses or touches itself"), 0U);
  const auto loop = cubic({{0, 0}, {30, 0}, {30, 20}, {-10, 5}, {25, -15}, {0, 20}, {0, 0}});
  EXPECT_NE(refused(loop).find("crosses or touches itself"), std::string::npos);
  const auto doubled = polyline({{0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 0}});
  EXPECT_NE(refused(doubled).find("coincide at (10, 0) mm"), std::string::npos);
  const auto spike = polyline({{0, 0}, {10, 0}, {20, 0}, {10, 0}, {5, 8}, {0, 0}});
  EXPECT_NE(refused(spike).find("turns back on itself at (20, 0) mm"), std::string::npos);
  EXPECT_NE(refused(polyline({{0, 0}, {10, 0}, {10, 10}})).find("the curve is open"),
            std::string::npos);
}

TEST(Extrude, DirectionOfTheProfileDoesNotMatter) {
  ProfileCurve curve = roundCurve(10, 6);
  const double forward = volume(SurfaceEvaluator(makePrimitive({ExtrudeShape{curve, 5}})));
  std::reverse(curve.points.begin(), curve.points.end());
  const double backward = volume(SurfaceEvaluator(makePrimitive({ExtrudeShape{curve, 5}})));
  EXPECT_GT(forward, 0.0);
  EXPECT_NEAR(forward, backward, 1e-9 * forward);
}

TEST(Extrude, RepresentsAProfileOfLowerDegreeExactly) {
  for (int degree : {3, 4, 5}) {
    const MadeSolid made = makeMeasuredPrimitive({ExtrudeShape{roundCurve(10, 6), 5}, degree});
    EXPECT_LT(made.deviation, 1e-12);
  }
  const double quadratic = makeMeasuredPrimitive({ExtrudeShape{roundCurve(10, 6), 5}, 2}).deviation;
  EXPECT_GT(quadratic, 1e-9);
  EXPECT_LT(quadratic, 0.01);
}

TEST(Extrude, EveryCornerOfTheProfileIsAnEdgeOfTheSolid) {
  // From three to eight corners, convex and non-convex.
  const std::vector<std::pair<ProfileCurve, int>> profiles{
      {cubic({{0, -20}, {25, 5}, {10, 25}, {-10, 25}, {-25, 5}, {0, -20}}), 1},  // a drop
      {polyline({{0, 0}, {30, 0}, {0, 20}, {0, 0}}), 3},
      {square(10), 4},
      {polyline({{20, 0}, {6, 19}, {-16, 12}, {-16, -12}, {6, -19}, {20, 0}}), 5},
      {polyline({{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}, {0, 0}}), 6},
      {polyline({{0, 0}, {9, 0}, {9, 5}, {20, 5}, {20, 0}, {30, 0}, {30, 12}, {0, 12}, {0, 0}}), 8},
  };
  for (const auto& [profile, corners] : profiles) {
    const Solid solid = makePrimitive({ExtrudeShape{profile, 7}});
    const auto between = [&](const SolidEdge& edge) {
      return solid.patches()[edge.uses[0].patch].name.rfind("side", 0) == 0 &&
             solid.patches()[edge.uses[1].patch].name.rfind("side", 0) == 0;
    };
    const auto sharp =
        std::count_if(solid.edges().begin(), solid.edges().end(),
                      [&](const SolidEdge& edge) { return between(edge) && !edge.smooth; });
    EXPECT_EQ(sharp, corners);
    const checks::EdgeAngles angles = edgeAngles(solid);
    EXPECT_LT(angles.largestSmooth, 0.5);
    EXPECT_GT(angles.smallestSharp, 30.0);
    EXPECT_GT(checks::smallestMeshAngle(solid, 2.0), 24.0);
  }
}

TEST(Extrude, RefusesACapThatWouldFold) {
  // The arms of a star allow no choice of four corners.
  std::vector<Eigen::Vector2d> star;
  for (int i = 0; i <= 10; ++i) {
    const double radius = i % 2 == 0 ? 20.0 : 5.0;
    star.emplace_back(radius * std::cos(kPi * i / 5), radius * std::sin(kPi * i / 5));
  }
  star.back() = star.front();
  EXPECT_EQ(refusal({ExtrudeShape{polyline(star), 5}}).find("extrude: the flat cap over the"), 0U);
  std::vector<Eigen::Vector2d> comb;
  for (int i = 0; i < 15; ++i) {
    comb.emplace_back(2.0 * i, 0);
    comb.emplace_back(2.0 * i + 1, 10);
  }
  comb.emplace_back(40, -5);
  comb.push_back(comb.front());
  EXPECT_NE(refusal({ExtrudeShape{polyline(comb), 5}}).find("corners; at most 24 are possible"),
            std::string::npos);
}

TEST(Extrude, RefusesHeightsAndNetsThatDoNotFit) {
  EXPECT_EQ(refusal({ExtrudeShape{square(5), 0}}).find("extrude: the height is 0 mm"), 0U);
  EXPECT_EQ(refusal({ExtrudeShape{square(5), std::nan("")}}).find("extrude: the height is nan"),
            0U);
  EXPECT_EQ(refusal({ExtrudeShape{roundCurve(10, 10), 5}, 3, 4})
                .find("extrude: 4 control points per direction; degree 3 needs at least"),
            0U);
}

TEST(Loft, OfEqualSectionsIsAnExtrusion) {
  const ProfileCurve profile = roundCurve(10, 6);
  const Solid loft = makePrimitive({LoftShape{{{0, profile}, {2, profile}, {5, profile}}}});
  const Solid extrusion = makePrimitive({ExtrudeShape{profile, 5}});
  EXPECT_NEAR(volume(SurfaceEvaluator(loft)) / volume(SurfaceEvaluator(extrusion)), 1.0, 1e-12);
}

TEST(Loft, PassesThroughItsSections) {
  const std::vector<double> radii{10, 14, 9, 12};
  const std::vector<double> heights{-3, 5, 20, 26};
  LoftShape loft;
  for (std::size_t i = 0; i < radii.size(); ++i)
    loft.sections.push_back({heights[i], roundCurve(radii[i], radii[i])});
  for (int degree = 1; degree <= 5; ++degree) {
    const Solid solid = makePrimitive({loft, degree});
    const SurfaceEvaluator surface(solid);
    const int side = *solid.findPatch("side_1");
    for (std::size_t i = 0; i < radii.size(); ++i) {
      // Heights are proportional to v; the seam of every section is at (radius, 0).
      const double v = (heights[i] + 3) / 29;
      const Eigen::Vector3d p = surface.position(side, 0.0, v);
      EXPECT_LT((p - Eigen::Vector3d(radii[i], 0, heights[i])).norm(), 1e-10) << degree;
    }
  }
}

TEST(Loft, JoinsSectionsOfDifferentDegreeKnotsAndCorners) {
  const Primitive primitive{LoftShape{{{0, square(15)}, {30, roundCurve(12, 12)}}}};
  const MadeSolid made = makeMeasuredPrimitive(primitive);
  EXPECT_LT(made.deviation, 1e-12);
  EXPECT_EQ(made.solid.patches().size(), 6U);
  const SurfaceEvaluator surface(made.solid);
  const double top = sectionArea(makePrimitive({ExtrudeShape{roundCurve(12, 12), 1}}), 1);
  EXPECT_LT(volume(surface), 30 * 900);
  EXPECT_GT(volume(surface), 30 * top);
  EXPECT_GT(checks::smallestMeshAngle(made.solid, 3.0), 24.0);
}

TEST(Loft, RefusesSectionsThatDoNotBelongTogether) {
  const auto refused = [](std::vector<LoftShape::Section> sections) {
    return refusal({LoftShape{std::move(sections)}});
  };
  EXPECT_EQ(refused({}), "loft: 0 sections; expected 2 … 32");
  EXPECT_EQ(refused({{0, square(5)}}), "loft: 1 sections; expected 2 … 32");
  EXPECT_EQ(refused({{0, square(5)}, {0, square(5)}}).find("loft: sections[1].z_mm: 0 must be"),
            0U);
  EXPECT_EQ(
      refused({{0, square(5)}, {std::nan(""), square(5)}}).find("loft: sections[1].z_mm: nan"), 0U);
  const ProfileCurve triangle = polyline({{-5, -5}, {5, -5}, {0, 5}, {-5, -5}});
  EXPECT_NE(refused({{0, square(5)}, {9, triangle}}).find("sections[1].profile has 3 corners"),
            std::string::npos);
  ProfileCurve open = square(5);
  open.points.back() = {-5, -4};
  EXPECT_EQ(refused({{0, square(5)}, {9, open}}).find("loft: sections[1].profile: the curve is"),
            0U);
  EXPECT_EQ(refused({{0, square(1e5)}, {9, square(5)}}).find("loft: the extent of a profile"), 0U);
}

TEST(Revolve, ProfileThatEndsOnTheAxisAtARightAngleHasASmoothPole) {
  const Solid dome = makePrimitive({RevolveShape{
      cubic({{0, -20}, {11, -20}, {20, -11}, {20, 0}, {20, 11}, {11, 20}, {0, 20}})}});
  EXPECT_EQ(dome.patches().size(), 6U);
  const SurfaceEvaluator surface(dome);
  const int top = *dome.findPatch("top");
  EXPECT_LT((surface.position(top, 0.5, 0.5) - Eigen::Vector3d(0, 0, 20)).norm(), 1e-3);
  EXPECT_GT(surface.normal(top, 0.5, 0.5).z(), 0.99999);
  EXPECT_LT(edgeAngles(dome).largestSmooth, 0.8);
  for (const SolidEdge& edge : dome.edges()) EXPECT_TRUE(edge.smooth);
}

TEST(Revolve, OpenEndsGetFlatCapsForBothDirectionsOfTheProfile) {
  for (bool upwards : {true, false}) {
    std::vector<Eigen::Vector2d> points{{15, 0}, {25, 15}, {5, 30}, {12, 45}};
    if (!upwards) std::reverse(points.begin(), points.end());
    const MadeSolid vase = makeMeasuredPrimitive({RevolveShape{cubic(points)}});
    const SurfaceEvaluator surface(vase.solid);
    // π ∫ r² dz of the cubic, by Simpson's rule with small steps.
    double exact = 0.0;
    constexpr int kSteps = 2000;
    const auto r = [](double t) {
      const double s = 1 - t;
      return 15 * s * s * s + 75 * s * s * t + 15 * s * t * t + 12 * t * t * t;
    };
    for (int i = 0; i < kSteps; ++i) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(i + 1) / kSteps;
      exact += kPi * 45.0 * (b - a) / 6 *
               (r(a) * r(a) + 4 * std::pow(r(0.5 * (a + b)), 2) + r(b) * r(b));
    }
    EXPECT_NEAR(volume(surface), exact, 2 * area(surface) * vase.deviation);
    EXPECT_TRUE(vase.solid.findPatch("bottom") && vase.solid.findPatch("top"));
  }
}

TEST(Revolve, AFlatCapContinuesARoundedRimSmoothly) {
  // The profile reaches the cap in radial direction.
  const Solid pill = makePrimitive({RevolveShape{cubic({{10, 0}, {16, 0}, {16, 8}, {10, 8}})}});
  for (const SolidEdge& edge : pill.edges()) EXPECT_TRUE(edge.smooth);
  EXPECT_LT(edgeAngles(pill).largestSmooth, 0.6);
}

TEST(Revolve, AClosedProfileOffTheAxisMakesARing) {
  const double tube = sectionArea(makePrimitive({ExtrudeShape{roundCurve(6, 6), 1}}), 1);
  const MadeSolid ring = makeMeasuredPrimitive({RevolveShape{roundCurve(6, 6, {20, 0})}});
  EXPECT_EQ(ring.solid.patches().size(), 16U);
  const SurfaceEvaluator surface(ring.solid);
  // Pappus: area times the path of the centroid, which deviates slightly from the circle's centre.
  EXPECT_NEAR(volume(surface) / (2 * kPi * 20 * tube), 1.0, 0.01);
  EXPECT_GT(checks::smallestMeshAngle(ring.solid, 2.0), 24.0);
}

TEST(Revolve, RefusesProfilesThatTouchOrCrossTheAxis) {
  const auto refused = [](const ProfileCurve& curve) { return refusal({RevolveShape{curve}}); };
  EXPECT_EQ(refused(polyline({{5, 0}, {0, 10}, {5, 20}})),
            "revolve: profile: the curve touches the axis near z = 10 mm between its ends; only "
            "the ends of an open curve may lie on it");
  EXPECT_NE(refused(polyline({{5, 0}, {-1, 10}, {5, 20}})).find("crosses the axis near z = 10 mm"),
            std::string::npos);
  EXPECT_NE(refused(cubic({{5, 0}, {-6, 5}, {-6, 15}, {5, 20}})).find("crosses the axis"),
            std::string::npos);
  EXPECT_NE(refused(polyline({{-5, 0}, {5, 10}})).find("crosses the axis near z = 0 mm"),
            std::string::npos);
  EXPECT_NE(refused(polyline({{1e-5, 0}, {5, 10}, {5, 20}})).find("mm away from the axis"),
            std::string::npos);
  EXPECT_NE(refused(polyline({{0, 0}, {5, 5}, {0, 10}, {0, 0}})).find("touches the axis"),
            std::string::npos);
  EXPECT_NE(refused(polyline({{0, 0}, {0, 5}, {5, 10}, {0, 20}})).find("axis"), std::string::npos);
  // The curve starts along the axis.
  EXPECT_NE(refused(cubic({{0, 0}, {0, 8}, {10, 10}, {10, 20}})).find("runs along the axis"),
            std::string::npos);
}

TEST(Revolve, RefusesACapThatCutsTheProfile) {
  // The end turns back below the rest, so its flat cap intersects the curve.
  EXPECT_NE(refusal({RevolveShape{polyline({{10, 0}, {10, 20}, {20, 20}, {20, 10}})}})
                .find("the flat cap that closes an end meets the curve near"),
            std::string::npos);
}

}  // namespace
}  // namespace palpa::modeling
