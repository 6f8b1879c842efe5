#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/arrow_mesh.h"
#include "app/view/layers/ring_dashes.h"
#include "app/view/layers/surface_shader.h"
#include "app/view/scene/arrows.h"
#include "app/view/scene/colour_map.h"
#include "app/view/scene/gradient_arrows.h"

// The geometry of arrows, labels, rings and colours during a simulation; nothing is drawn.
namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

ForceArrow arrow(double force) {
  return {{1, 2, 3}, {0, 0, force}, ForceArrow::Anchor::kTail, ForceArrow::Role::kApplied, ""};
}

double drawnLength(double force, double fullForce) {
  const LiveArrows live{{arrow(force)}, fullForce};
  const auto placed = placeArrows(live, 20);
  return placed.empty() ? 0 : (placed[0].tip - placed[0].tail).norm();
}

TEST(LiveArrows, AreAsLongAsTheirForceUpToTheFullOne) {
  EXPECT_DOUBLE_EQ(drawnLength(2, 2), 20);
  EXPECT_DOUBLE_EQ(drawnLength(1, 2), 10);
  EXPECT_NEAR(drawnLength(0.02, 2), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(drawnLength(50, 2), 20);
  EXPECT_EQ(drawnLength(0, 2), 0);
  EXPECT_EQ(drawnLength(1e-4, 2), 0);
  EXPECT_EQ(drawnLength(std::numeric_limits<double>::quiet_NaN(), 2), 0);
}

TEST(LiveArrows, DoNotDependOnEachOther) {
  const LiveArrows live{{arrow(1), arrow(100)}, 4};
  const auto placed = placeArrows(live, 20);
  ASSERT_EQ(placed.size(), 2);
  EXPECT_DOUBLE_EQ((placed[0].tip - placed[0].tail).norm(), 5);
}

TEST(LiveArrows, EndOrBeginWhereTheyAreHeld) {
  LiveArrows live{{arrow(1), arrow(1)}, 1};
  live.arrows[1].anchor = ForceArrow::Anchor::kTip;
  const auto placed = placeArrows(live, 20);
  EXPECT_EQ(placed[0].tail, Vector3d(1, 2, 3));
  EXPECT_EQ(placed[0].freeEnd(), Vector3d(1, 2, 23));
  EXPECT_EQ(placed[1].tip, Vector3d(1, 2, 3));
  EXPECT_EQ(placed[1].freeEnd(), Vector3d(1, 2, -17));
}

TEST(LiveArrows, MomentsHaveOneLengthAndDoNotScaleForces) {
  LiveArrows live{{arrow(1), arrow(500)}, 2};
  live.arrows[1].kind = ForceArrow::Kind::kMoment;
  EXPECT_DOUBLE_EQ(largestForce(live.arrows), 1);
  const auto placed = placeArrows(live, 20);
  ASSERT_EQ(placed.size(), 2);
  EXPECT_DOUBLE_EQ((placed[0].tip - placed[0].tail).norm(), 10);
  EXPECT_DOUBLE_EQ((placed[1].tip - placed[1].tail).norm(), 20 * kMomentLength);
  live.arrows[1].force.setZero();
  EXPECT_EQ(placeArrows(live, 20).size(), 1);
  EXPECT_EQ(largestForce({}), 1);
}

TEST(GradientArrows, HideSmallGradientsAndLabelTheLargest) {
  Eigen::Matrix3Xd gradient = Eigen::Matrix3Xd::Zero(3, 6);
  gradient.row(2) << 0.5 * kMinGradientShare, 1, -0.8, 0.3, 2 * kMinGradientShare, 0;
  const std::vector<Vector3d> places(6, Vector3d(1, 2, 3));
  const auto label = [](double value) { return std::to_string(value).substr(0, 3); };
  EXPECT_EQ(pointsWithArrows(gradient), (std::vector<int>{1, 2, 3, 4}));
  const LiveArrows arrows = gradientArrows(gradient, places, label);
  EXPECT_EQ(arrows.fullForce, 1);
  ASSERT_EQ(arrows.arrows.size(), 4u);
  EXPECT_EQ(arrows.arrows[0].label, "1.0");
  EXPECT_EQ(arrows.arrows[1].label, "0.8");
  EXPECT_EQ(arrows.arrows[2].label, "0.3");
  EXPECT_EQ(arrows.arrows[3].label, "");
  EXPECT_EQ(arrows.arrows[1].force, Vector3d(0, 0, -0.8));
  // Nothing to pull: no arrows, and a scale that can be drawn.
  EXPECT_TRUE(pointsWithArrows(Eigen::Matrix3Xd::Zero(3, 4)).empty());
  EXPECT_TRUE(gradientArrows(Eigen::Matrix3Xd(3, 0), {}, label).arrows.empty());
  EXPECT_GT(gradientArrows(Eigen::Matrix3Xd::Zero(3, 6), places, label).fullForce, 0);
}

TEST(VolumeCentre, IsTheCentroidOfATetrahedron) {
  const std::vector<Vector3d> corners{{1, 1, 1}, {5, 1, 1}, {1, 9, 1}, {1, 1, 3}};
  const std::vector<Triangle> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_LT((volumeCentre(corners, faces) - Vector3d(2, 3, 1.5)).norm(), 1e-14);
}

TEST(SolidArrow, ShrinksInAllDirectionsWhenItIsShort) {
  const auto withLength = [](double length) {
    return SolidArrow::of({0, 0, 0}, {length, 0, 0}, 100, {});
  };
  const SolidArrow full = withLength(30);
  EXPECT_DOUBLE_EQ(full.headLength, 100 * kArrowHeadLength);
  EXPECT_DOUBLE_EQ(withLength(60).headRadius, full.headRadius);
  const SolidArrow tiny = withLength(0.3);
  EXPECT_DOUBLE_EQ(tiny.headLength, 0.18);
  EXPECT_NEAR(tiny.headRadius / tiny.headLength, full.headRadius / full.headLength, 1e-12);
  EXPECT_NEAR(tiny.shaftRadius / tiny.headLength, full.shaftRadius / full.headLength, 1e-12);
}

/// Six times the volume within the surface: positive if it is closed and oriented outwards.
double volume(vtkPolyData* surface) {
  double sum = 0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface->GetPolys()->GetNumberOfCells(); ++i) {
    surface->GetPolys()->GetCellAtId(i, corners);
    std::array<Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      surface->GetPoint(corners->GetId(static_cast<vtkIdType>(k)), p[k].data());
    sum += p[0].dot(p[1].cross(p[2])) / 6;
  }
  return sum;
}

TEST(ArrowMesh, HasTheVolumeOfACylinderAndACone) {
  const Vector3d tail(3, -2, 5);
  const Vector3d tip = tail + 10 * Vector3d(0.3, -0.5, 0.8).normalized();
  ArrowMesh mesh;
  mesh.set({{tail, tip, 0.5, 1.5, 4, {}}});
  const double expected = std::numbers::pi * (0.25 * 6 + 2.25 * 4 / 3);
  EXPECT_NEAR(volume(mesh.surface()), expected, 0.02 * expected);  // 24 sides
  mesh.set({{tail, tip, 0.5, 1.5, 4, {}}, {tip, tail, 0.5, 1.5, 4, {}}});
  EXPECT_NEAR(volume(mesh.surface()), 2 * expected, 0.04 * expected);
  mesh.set({});
  EXPECT_EQ(mesh.surface()->GetNumberOfPolys(), 0);
}

TEST(ArrowMesh, TurnsAreRightHandedAndClosed) {
  const Vector3d tail(3, -2, 5), tip = tail + 40 * Vector3d(0.6, 0, 0.8);
  ArrowMesh mesh;
  const SolidArrow turn = SolidArrow::turning(tail, tip, 0.6, 100, {});
  mesh.set({turn});
  // Shaft, torus of 270° less the head, and cone.
  const double pi = std::numbers::pi, r = turn.shaftRadius;
  const double arc = 1.5 * pi * turn.turnRadius - turn.headLength;
  const double expected =
      pi * r * r * (40 + arc) + pi * turn.headRadius * turn.headRadius * turn.headLength / 3;
  EXPECT_NEAR(volume(mesh.surface()), expected, 0.03 * expected);
  // The tip of the curved arrow, the last point, lies ahead of its base in the sense of the turn.
  const vtkIdType count = mesh.surface()->GetNumberOfPoints();
  Vector3d head, base = Vector3d::Zero(), corner;
  mesh.surface()->GetPoint(count - 1, head.data());
  for (vtkIdType i = count - 48; i < count - 24; ++i) {
    mesh.surface()->GetPoint(i, corner.data());
    base += corner / 24;
  }
  const Vector3d centre = tail + 0.6 * (tip - tail);
  EXPECT_GT((base - centre).cross(head - centre).dot(tip - tail), 0);
  EXPECT_NEAR((base - centre).norm(), turn.turnRadius, 1e-4);
  mesh.set({SolidArrow::of(tail, tip, 100, {})});
  EXPECT_LT(mesh.surface()->GetNumberOfPoints(), count);
}

constexpr double kGap = 8;
const Vector2d kPicture(400, 300);

TEST(ArrowLabel, StandsBeyondTheEnd) {
  const PixelBox box = placeArrowLabel({{200, 150}, {1, 0}, {60, 20}}, kPicture, kGap, {}).box;
  EXPECT_DOUBLE_EQ(box.low.x(), 208);
  EXPECT_DOUBLE_EQ(box.low.y(), 140);
  EXPECT_DOUBLE_EQ(box.high.x(), 268);
}

TEST(ArrowLabel, GivesWay) {
  std::vector<PixelBox> taken;
  for (int i = 0; i < 6; ++i) {
    const PixelBox box =
        placeArrowLabel({{200, 150}, {0, -1}, {60, 20}}, kPicture, kGap, taken).box;
    for (const PixelBox& other : taken) EXPECT_EQ(box.overlap(other), 0) << i;
    taken.push_back(box);
  }
}

/// An obstacle trembles at the border of the place of a label.
TEST(ArrowLabel, DoesNotJumpToAndFro) {
  const ArrowLabelWish wish{{200, 150}, {1, 0}, {60, 20}};
  const PixelBox ahead = placeArrowLabel(wish, kPicture, kGap, {}).box;
  const auto other = [&](double gap) {
    return std::vector<PixelBox>{{{ahead.high.x() + gap, 100}, {ahead.high.x() + gap + 50, 200}}};
  };
  int memoryless = 0, jumps = 0, last = 0;
  std::optional<int> choice;
  for (int frame = 0; frame < 40; ++frame) {
    const auto taken = other(frame % 2 ? 1 : -1);
    const int without = placeArrowLabel(wish, kPicture, kGap, taken).choice;
    memoryless += without != last && frame > 0 ? 1 : 0;
    last = without;
    const int next = placeArrowLabel(wish, kPicture, kGap, taken, choice).choice;
    jumps += choice && next != *choice ? 1 : 0;
    choice = next;
  }
  EXPECT_GT(memoryless, 30);
  EXPECT_LE(jumps, 1);
  // Once there is room enough, the first choice is taken again.
  EXPECT_EQ(placeArrowLabel(wish, kPicture, kGap, other(2 * kGap), choice).choice, 0);
}

TEST(ArrowLabel, StaysInThePictureAsLongAsTheEndDoes) {
  for (const Vector2d& end : {Vector2d(1, 1), Vector2d(399, 150), Vector2d(200, 299)}) {
    for (const Vector2d& along : {Vector2d(1, 0), Vector2d(-1, -1), Vector2d(0, 0)}) {
      const PixelBox box = placeArrowLabel({end, along, {60, 20}}, kPicture, kGap, {}).box;
      EXPECT_TRUE((box.low.array() >= 0).all());
      EXPECT_TRUE((box.high.array() <= kPicture.array()).all());
    }
  }
  const PixelBox outside =
      placeArrowLabel({{-300, 150}, {-1, 0}, {60, 20}}, kPicture, kGap, {}).box;
  EXPECT_LT(outside.high.x(), 0);
}

TEST(SeenPart, EndsAtTheEdgeOfThePicture) {
  const auto right = seenPart({300, 100}, {500, 200}, kPicture);
  ASSERT_TRUE(right);
  EXPECT_TRUE(right->free.isApprox(Vector2d(400, 150)));
  EXPECT_EQ(right->held, Vector2d(300, 100));
  EXPECT_TRUE(seenPart({100, 100}, {-300, -100}, kPicture)->free.isApprox(Vector2d(0, 50)));
  EXPECT_EQ(seenPart({100, 100}, {200, 50}, kPicture)->free, Vector2d(200, 50));
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(seenPart({100, 100}, {nowhere, nowhere}, kPicture));
}

std::vector<Vector3d> circle(int corners) {
  std::vector<Vector3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return points;
}

double lengthOf(const std::vector<Vector3d>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

TEST(RingDashes, ShareTheLengthEvenly) {
  for (const int corners : {3, 7, 100}) {
    const std::vector<Vector3d> ring = circle(corners);
    const double length = 2 * corners * std::sin(std::numbers::pi / corners);
    const auto dashes = ringDashes(ring, 12, 0.4);
    ASSERT_EQ(dashes.size(), 12);
    for (const auto& dash : dashes) EXPECT_NEAR(lengthOf(dash), 0.4 * length / 12, 1e-12);
  }
}

TEST(RingDashes, AWholeRingIsClosed) {
  const auto whole = ringDashes(circle(5), 1, 1);
  ASSERT_EQ(whole.size(), 1);
  EXPECT_EQ(whole[0].size(), 6);
  EXPECT_EQ(whole[0].front(), whole[0].back());
}

TEST(RingDashes, RingsWithoutLengthAreNotDrawn) {
  EXPECT_TRUE(ringDashes({}, 4, 0.5).empty());
  EXPECT_TRUE(ringDashes({{1, 2, 3}}, 4, 0.5).empty());
  EXPECT_TRUE(ringDashes({{1, 2, 3}, {1, 2, 3}}, 1, 1).empty());
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ringDashes({{1, 2, 3}, {nowhere, 0, 0}}, 4, 0.5).empty());
  EXPECT_EQ(ringDashes({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 4, 0.5).size(), 4);
}

TEST(ColourFit, FollowsTheMap) {
  for (const auto colours : {ScalarField::Colours::kSequential, ScalarField::Colours::kDiverging}) {
    constexpr int kSteps = 101;
    const ColourFit fit = fitColours(colours);
    const std::vector<Colour> map = colourSteps(colours, kSteps);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const Colour fitted = fit.at(static_cast<double>(i) / (kSteps - 1));
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(fitted[k], map[i][k], 0.02) << i;
    }
  }
}

TEST(PlaceInColours, StaysFiniteAndFarFromNowhere) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FLOAT_EQ(placeInColours(0.25), 0.25F);
  EXPECT_GE(placeInColours(-kInfinity), -2000);
  EXPECT_LE(placeInColours(kInfinity), 2000);
  EXPECT_LT(placeInColours(std::numeric_limits<double>::quiet_NaN()), -1e5);
}

}  // namespace
}  // namespace palpa::view
