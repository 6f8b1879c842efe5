// Drawing and editing of profile curves, without a window.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "modeling/error.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/profile.h"
#include "modeling/shapes/profile_check.h"
#include "modeling/shapes/profile_error.h"
#include "modeling/shapes/sketch_history.h"
#include "modeling/shapes/sketch_picking.h"
#include "shape_checks.h"

namespace palpa::modeling {
namespace {

using checks::cubic;
using checks::polyline;
using checks::roundCurve;
using Eigen::Vector2d;
using Kind = SketchPointKind;

/// Largest distance of the points of one curve from the other, both sampled densely.
double distanceBetween(const ProfileSketch& a, const ProfileSketch& b) {
  double largest = 0.0;
  const auto samples = b.samples();
  for (const SketchPlace& place : a.samples())
    if (const auto nearest = nearestSketchPlace(samples, place.at, 1e9))
      largest = std::max(largest, (nearest->at - place.at).norm());
  return largest;
}

ProfileSketch drawn(const std::vector<Vector2d>& points, Kind kind) {
  ProfileSketch sketch;
  for (const Vector2d& point : points) sketch.append(point, kind);
  return sketch;
}

TEST(ProfileSketch, AnUneditedCurveKeepsItsShape) {
  ProfileCurve uneven = roundCurve(20, 9);
  uneven.knots[5] = 1.3;
  for (const ProfileCurve& curve :
       {polyline({{0, 0}, {40, 0}, {40, 12}, {12, 12}, {12, 40}, {0, 40}, {0, 0}}),
        roundCurve(20, 9), uneven, cubic({{14, 0}, {24, 8}, {27, 22}, {16, 34}, {10, 44}})}) {
    const ProfileCurve again = ProfileSketch(curve).curve();
    const Profile before(curve, "before"), after(again, "after");
    EXPECT_EQ(before.isClosed(), after.isClosed());
    EXPECT_EQ(curve.degree, again.degree);
    for (double t = 0.0; t <= 1.0; t += 1.0 / 64)
      EXPECT_LT((before.point(t) - after.point(t)).norm(), 1e-12 * before.size());
  }
}

TEST(ProfileSketch, ClicksWithCornersMakeAPolylineOfDegreeOne) {
  ProfileSketch sketch = drawn({{0, 0}, {30, 0}, {30, 10}, {0, 20}}, Kind::kCorner);
  sketch.close();
  const ProfileCurve curve = sketch.curve();
  EXPECT_EQ(curve.degree, 1);
  EXPECT_EQ(curve, polyline({{0, 0}, {30, 0}, {30, 10}, {0, 20}, {0, 0}}));
  EXPECT_NO_THROW(checkClosedProfile(curve, "profile"));
}

TEST(ProfileSketch, ASmoothClosedCurveIsSmoothEverywhereAndKeepsItsPoints) {
  const std::vector<Vector2d> clicks{{20, 0}, {10, 18}, {-12, 16}, {-20, 0}, {-9, -17}, {12, -14}};
  ProfileSketch sketch = drawn(clicks, Kind::kControl);
  sketch.close();
  ASSERT_TRUE(sketch.isClosed());
  const Profile profile(sketch.curve(), "profile");
  EXPECT_TRUE(profile.isClosed());
  EXPECT_TRUE(profile.corners().empty());
  EXPECT_LT(profile.turn(0.0), 2e-3);  // measured by chords
  // Curvature, too, is continuous at the seam: the curve is the periodic spline of the clicks.
  const double h = 1e-3;
  const Vector2d before =
      profile.point(1.0 - 2 * h) - 2.0 * profile.point(1.0 - h) + profile.point(0.0);
  const Vector2d after = profile.point(0.0) - 2.0 * profile.point(h) + profile.point(2 * h);
  EXPECT_LT((before - after).norm(), 0.02 * before.norm());
  for (std::size_t i = 1; i < clicks.size(); ++i)
    EXPECT_EQ(nearestSketchPoint(sketch, clicks[i], 1e-12) >= 0, true) << i;
}

TEST(ProfileSketch, CornersAndSmoothPointsMix) {
  // A straight foot, and an arch above it.
  ProfileSketch sketch;
  sketch.append({-20, 0}, Kind::kCorner);
  sketch.append({20, 0}, Kind::kCorner);
  sketch.append({22, 15}, Kind::kControl);
  sketch.append({0, 30}, Kind::kControl);
  sketch.append({-22, 15}, Kind::kControl);
  sketch.close();
  const Profile profile(sketch.curve(), "profile");
  EXPECT_EQ(profile.corners().size(), 2U);
  EXPECT_NO_THROW(makePrimitive({ExtrudeShape{sketch.curve(), 10}}));
  // The foot stays straight when an end moves.
  sketch.move({1}, {0, -5});
  for (double u : {0.25, 0.5, 0.75})
    EXPECT_LT((sketch.at(0, u) - (Vector2d(-20, 0) + u * Vector2d(40, -5))).norm(), 1e-12);
}

TEST(ProfileSketch, InsertedPointsKeepTheShape) {
  for (const ProfileCurve& curve :
       {roundCurve(20, 6), polyline({{0, 0}, {9, 0}, {4, 7}, {0, 0}})}) {
    const ProfileSketch before{curve};
    ProfileSketch sketch = before;
    for (double at : {0.1, 0.37, 0.5, 0.83}) {
      const auto samples = sketch.samples();
      const SketchPlace place =
          samples[static_cast<std::size_t>(at * static_cast<double>(samples.size() - 1))];
      const int point = sketch.insert(place);
      EXPECT_GT(point, 0);
      EXPECT_LT(point, sketch.pointCount());
    }
    EXPECT_GE(sketch.pointCount(), before.pointCount() + 4);
    EXPECT_LT(distanceBetween(before, sketch), 1e-3 * 20);
    EXPECT_NO_THROW(checkProfileCurve(sketch.curve(), "profile"));
  }
}

TEST(ProfileSketch, ACornerIsOnTheCurveAndCanBeSmoothedAgain) {
  ProfileSketch sketch{cubic({{0, 0}, {10, 15}, {20, -5}, {30, 15}, {40, 0}})};
  const Vector2d place = sketch.points()[2].at;
  EXPECT_GT((nearestSketchPlace(sketch.samples(), place, 100.0)->at - place).norm(), 0.2);
  sketch.makeCorner(2);
  EXPECT_LT((nearestSketchPlace(sketch.samples(), place, 100.0)->at - place).norm(), 1e-9);
  EXPECT_GT(Profile(sketch.curve(), "profile").corners().size(), 0U);
  sketch.makeSmooth(2);
  EXPECT_EQ(sketch.points()[2].at, place);
  EXPECT_FALSE(sketch.isOnCurve(2));
  EXPECT_TRUE(Profile(sketch.curve(), "profile").corners().empty());
}

TEST(ProfileSketch, NeighboursOfASmoothPointStayInLine) {
  ProfileSketch sketch = drawn({{20, 0}, {0, 20}, {-20, 0}, {0, -20}}, Kind::kControl);
  sketch.close();
  ASSERT_EQ(sketch.points()[0].kind, Kind::kSmooth);
  sketch.move({1}, {3, 4});
  sketch.move({0}, {5, -2});
  EXPECT_LT(Profile(sketch.curve(), "profile").turn(0.0), 2e-3);
}

TEST(ProfileSketch, AMirrorImageClosesHalfACurve) {
  ProfileSketch half;
  half.append({0, -10}, Kind::kCorner);
  half.append({15, -8}, Kind::kControl);
  half.append({18, 3}, Kind::kControl);
  half.append({0, 20}, Kind::kCorner);
  const ProfileSketch before = half;
  EXPECT_FALSE(ProfileSketch(half).addMirrorImage(1, 0.0, 1e-9));
  ASSERT_TRUE(half.addMirrorImage(0, 0.0, 1e-9));
  EXPECT_TRUE(half.isClosed());
  const auto [low, high] = half.box();
  EXPECT_NEAR(low.x(), -high.x(), 1e-9);
  EXPECT_LT(distanceBetween(before, half), 1e-9);
  EXPECT_NO_THROW(checkClosedProfile(half.curve(), "profile"));
}

TEST(ProfileSketch, TheBoxIsExact) {
  // A semicircle-like arch whose top lies between samples.
  const ProfileSketch sketch{cubic({{0, 0}, {0, 10}, {17, 10}, {17, 0}})};
  EXPECT_NEAR(sketch.box()[1].y(), 7.5, 1e-9);
  EXPECT_EQ(sketch.box()[0], Vector2d(0, 0));
}

TEST(ProfileSketch, AnySequenceOfEditsGivesAValidStructure) {
  std::mt19937 random(7);
  const auto number = [&](int below) {
    return static_cast<int>(random() % static_cast<unsigned>(below));
  };
  for (int round = 0; round < 24; ++round) {
    ProfileSketch sketch;
    if (round % 3 == 1) sketch = ProfileSketch(roundCurve(20, 5 + round % 7));
    if (round % 3 == 2) sketch = ProfileSketch(polyline({{0, 0}, {9, 0}, {4, 7}, {0, 0}}));
    for (int step = 0; step < 60; ++step) {
      const int count = sketch.pointCount();
      const Vector2d at(number(1000) * 0.1, number(1000) * 0.1);
      switch (number(9)) {
        case 0:
          sketch.close();
          break;
        case 1:
          if (number(4) == 0) sketch.open();
          break;
        case 2:
          if (count > 0) sketch.remove({number(count), number(count)});
          break;
        case 3:
          if (count > 0) sketch.makeCorner(number(count));
          break;
        case 4:
          if (count > 0) sketch.makeSmooth(number(count));
          break;
        case 5:
          if (count > 0) sketch.move({number(count), number(count)}, at - Vector2d(50, 50));
          break;
        case 6: {
          const auto samples = sketch.samples();
          if (!samples.empty() && count < 60)
            sketch.insert(
                samples[static_cast<std::size_t>(number(static_cast<int>(samples.size())))]);
          break;
        }
        default:
          sketch.append(at, number(2) == 0 ? Kind::kCorner : Kind::kControl);
      }
      if (!sketch.isCurve()) continue;
      try {
        checkProfileCurve(sketch.curve(), "profile");
      } catch (const ModelingError& error) {
        // Two points can be at one location; everything else must be right.
        if (std::string(error.what()).find("all lie within") != std::string::npos) continue;
        FAIL() << "round " << round << " step " << step << ": " << error.what();
      }
      // What the editor draws is what is stored.
      const ProfileCurve curve = sketch.curve();
      EXPECT_LT((sketch.samples().front().at - curve.points.front()).norm(), 1e-9);
      EXPECT_LT((sketch.samples().back().at - curve.points.back()).norm(), 1e-9);
      EXPECT_LT(distanceBetween(sketch, ProfileSketch(curve)), 1e-6);
    }
  }
}

TEST(ProfileSketch, ErrorsNameTheirLocation) {
  const auto locationOf = [](const auto& check) -> std::optional<Vector2d> {
    try {
      check();
    } catch (const ProfileError& error) {
      return error.location();
    }
    return std::nullopt;
  };
  const auto bowTie = polyline({{0, 0}, {10, 10}, {10, 0}, {0, 10}, {0, 0}});
  const auto crossing = locationOf([&] { checkClosedProfile(bowTie, "profile"); });
  ASSERT_TRUE(crossing);
  EXPECT_LT((*crossing - Vector2d(5, 5)).norm(), 1e-9);
  const auto open = locationOf([] {
    checkClosedProfile(polyline({{0, 0}, {10, 0}, {10, 10}}), "profile");
  });
  ASSERT_TRUE(open);
  EXPECT_EQ(*open, Vector2d(10, 10));
  const auto axis = locationOf([] {
    checkRevolvedProfile(polyline({{10, 0}, {-5, 10}, {10, 20}}));
  });
  ASSERT_TRUE(axis);
  EXPECT_LT(std::abs(axis->y() - 10.0), 1e-6);
  EXPECT_NO_THROW(checkRevolvedProfile(cubic({{25, 0}, {25, 9}, {21, 18}, {12, 24}, {0, 24}})));
}

TEST(SketchPicking, SnapsToPointsThenLinesThenTheGrid) {
  SnapRules rules;
  rules.reach = 0.5;
  rules.gridStep = 2.0;
  rules.points = {{7.3, 4.1}};
  EXPECT_EQ(snapped({7.2, 4.4}, rules).at, Vector2d(7.3, 4.1));
  EXPECT_EQ(snapped({7.2, 9.2}, rules).at, Vector2d(7.3, 10.0));
  EXPECT_EQ(snapped({0.3, 9.2}, rules).at, Vector2d(0.0, 10.0));
  EXPECT_EQ(snapped({3.2, -5.2}, rules).at, Vector2d(4.0, -6.0));
  rules.toAxes = false;
  rules.gridStep = 0.0;
  EXPECT_EQ(snapped({0.3, -5.2}, rules).at, Vector2d(0.3, -5.2));
  EXPECT_EQ(gridStep(0.7, 1.0), 1.0);
  EXPECT_EQ(gridStep(1.2, 1.0), 2.0);
  EXPECT_NEAR(gridStep(30.0, 25.4), 50.8, 1e-9);
}

TEST(SketchHistory, OneDragIsOneStep) {
  SketchHistory history({{0.0, ProfileSketch(roundCurve(20, 6))}});
  auto moved = history.present();
  for (int i = 0; i < 5; ++i) {
    moved[0].profile.move({2}, {1, 0});
    history.record(moved, "Move", i > 0);
  }
  moved[0].profile.move({3}, {1, 0});
  history.record(moved, "Move");
  history.record(moved, "Nothing");
  EXPECT_EQ(history.undoName(), "Move");
  history.undo();
  history.undo();
  EXPECT_FALSE(history.canUndo());
  EXPECT_EQ(history.present()[0].profile, ProfileSketch(roundCurve(20, 6)));
  history.redo();
  history.record({{1.0, {}}}, "Other");
  EXPECT_FALSE(history.canRedo());
  history.drop();
  EXPECT_FALSE(history.canRedo());
  EXPECT_EQ(history.undoName(), "Move");
}

TEST(ShapeSketch, AnUnchangedSectionKeepsItsKnots) {
  ProfileCurve odd = roundCurve(20, 9);
  for (double& knot : odd.knots) knot *= 0.37;
  LoftShape loft{{{0, odd}, {10, roundCurve(15, 6)}, {20, odd}}};
  Primitive primitive{loft, 4, 20};
  std::vector<SketchSection> sections = sectionsOf(primitive);
  EXPECT_EQ(withSections(primitive, sections), primitive);
  sections[1].profile.move({2}, {1, 1});
  const Primitive edited = withSections(primitive, sections);
  const auto& changed = std::get<LoftShape>(edited.shape);
  EXPECT_EQ(changed.sections[0].profile, odd);
  EXPECT_NE(changed.sections[1].profile, loft.sections[1].profile);
  sections[2].profile = {};
  EXPECT_THROW(withSections(primitive, sections), ModelingError);
}

}  // namespace
}  // namespace palpa::modeling
