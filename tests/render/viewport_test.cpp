#include "app/view/viewport/viewport.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/layers/grid_actor.h"
#include "app/view/layers/vtk_arrays.h"
#include "base/round_number.h"
#include "modeling/shapes/primitives.h"
#include "tests/render/viewport_scenes.h"

// Nothing is drawn here: these tests need no display.
namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A box of 40 × 30 × 20 on the ground, seen from the front, both projections.
class ViewportTest : public testing::TestWithParam<bool> {
 protected:
  ViewportTest() {
    window->SetOffScreenRendering(1);
    window->SetSize(800, 600);
    viewport.setBody(body);
    viewport.setControlNet(net);
    viewport.setParallelProjection(GetParam());
    viewport.lookFrom(StandardView::kFront);
    viewport.fit();
  }

  int pointAt(const Vector3d& place) const {
    const auto found = std::find_if(net.points.begin(), net.points.end(),
                                    [&](const Vector3d& p) { return (p - place).norm() < 1e-9; });
    EXPECT_NE(found, net.points.end());
    return static_cast<int>(found - net.points.begin());
  }

  modeling::Solid solid = modeling::makeBox({40, 30, 20});
  ViewportBody body = render_tests::viewportBody(solid);
  ControlNet net = render_tests::controlNet(solid);
  vtkNew<vtkRenderWindow> window;
  Viewport viewport{window};
};

INSTANTIATE_TEST_SUITE_P(Projections, ViewportTest, testing::Bool(), [](const auto& parameter) {
  return parameter.param ? "parallel" : "perspective";
});

TEST_P(ViewportTest, SurfaceUnderAKnownPixel) {
  const Vector3d front(7, -15, 12);
  const auto hit = viewport.surfaceAt(viewport.toPixel(front));
  ASSERT_TRUE(hit);
  EXPECT_NEAR((hit->position - front).norm(), 0, 1e-9);
  const int patch = body.patchOfTriangle[static_cast<std::size_t>(hit->triangle)];
  EXPECT_EQ(solid.patches()[static_cast<std::size_t>(patch)].name, "side_ymin");
  EXPECT_FALSE(viewport.surfaceAt({3, 3}));
}

TEST_P(ViewportTest, TheSurfaceIsPickedWhereItWasMovedTo) {
  ViewportBody moved = body;
  for (Vector3d& p : moved.positions) p += Vector3d(0, -5, 0);
  viewport.moveBody(moved.positions, moved.normals);
  const auto hit = viewport.surfaceAt(viewport.toPixel({7, -20, 12}));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->position.y(), -20, 1e-9);
}

TEST_P(ViewportTest, ControlPointUnderThePixel) {
  const int corner = pointAt({20, -15, 20});
  const Vector2d pixel = viewport.toPixel({20, -15, 20});
  EXPECT_EQ(viewport.controlPointAt(pixel), corner);
  EXPECT_EQ(viewport.controlPointAt(pixel + Vector2d(5, -5)), corner);
  EXPECT_FALSE(viewport.controlPointAt(pixel + Vector2d(7, -7)));
  EXPECT_EQ(viewport.controlPointAt(pixel + Vector2d(7, -7), 12), corner);
  viewport.setControlNetVisible(false);
  EXPECT_FALSE(viewport.controlPointAt(pixel));
}

TEST_P(ViewportTest, WhatIsInFrontIsPicked) {
  // Two points on one line of sight, one on either side of the body.
  const Vector2d pixel(400, 300);
  const Vector3d front = viewport.inViewPlane(pixel, {0, -40, 0});
  const Vector3d back = viewport.inViewPlane(pixel, {0, 40, 0});
  viewport.setControlNet({{back, front}, {}});
  EXPECT_EQ(viewport.controlPointAt(pixel), 1);
  viewport.setControlNet({{front, back}, {}});
  EXPECT_EQ(viewport.controlPointAt(pixel), 0);
}

TEST_P(ViewportTest, HiddenPointsArePickedWhereNoVisibleOneIsAsNear) {
  const Vector2d pixel(400, 300);
  const Vector3d hidden = viewport.inViewPlane(pixel, {0, 40, 0});
  const auto visibleAt = [&](double aside) {
    return viewport.inViewPlane(pixel + Vector2d(aside, 0), {0, -40, 0});
  };
  viewport.setControlNet({{hidden}, {}});
  EXPECT_EQ(viewport.controlPointAt(pixel), 0);
  viewport.setControlNet({{hidden, visibleAt(4)}, {}});
  EXPECT_EQ(viewport.controlPointAt(pixel), 1);
  viewport.setControlNet({{hidden, visibleAt(8)}, {}});
  EXPECT_EQ(viewport.controlPointAt(pixel), 0);
}

TEST_P(ViewportTest, BoxSelectFindsHiddenPointsToo) {
  const Vector2d a = viewport.toPixel({10, -15, 10});
  // Right part of the box: all points with x = 20 and, in perspective, the nearer third.
  const std::vector<int> found = viewport.controlPointsIn({800, 0}, {a.x(), 600});
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  for (std::size_t i = 0; i < net.points.size(); ++i) {
    const bool inside = viewport.toPixel(net.points[i]).x() >= a.x();
    EXPECT_EQ(std::binary_search(found.begin(), found.end(), static_cast<int>(i)), inside);
    if (net.points[i].x() == 20) {
      EXPECT_TRUE(inside);
    }
  }
  EXPECT_TRUE(viewport.controlPointsIn({1, 1}, {2, 2}).empty());
}

TEST_P(ViewportTest, GizmoArrowsUnderThePixel) {
  EXPECT_EQ(viewport.gizmoAt({400, 300}), GizmoAxis::kNone);
  const Vector3d at = viewport.inViewPlane({400, 300}, {0, 0, 10});
  viewport.setGizmo(Gizmo{at, Vector3d(-1, 0, 1).normalized()});
  EXPECT_EQ(viewport.gizmoAt({460, 302}), GizmoAxis::kX);
  EXPECT_EQ(viewport.gizmoAt({398, 230}), GizmoAxis::kZ);
  EXPECT_EQ(viewport.gizmoAt({355, 255}), GizmoAxis::kNormal);
  EXPECT_EQ(viewport.gizmoAt({400, 300}), GizmoAxis::kAll);
  EXPECT_EQ(viewport.gizmoAt({460, 315}), GizmoAxis::kNone);
  EXPECT_EQ(viewport.gizmoAt({510, 300}), GizmoAxis::kNone);
  // The y axis points away from the eye: it is neither drawn nor picked.
  viewport.setGizmo(Gizmo{at, std::nullopt});
  for (int x = 300; x <= 500; x += 2) {
    for (int y = 200; y <= 400; y += 2) EXPECT_NE(viewport.gizmoAt({x, y}), GizmoAxis::kY);
  }
}

TEST_P(ViewportTest, GizmoKeepsItsSizeInPixels) {
  viewport.setGizmo(Gizmo{{0, 0, 10}, std::nullopt});
  for (const double factor : {1.0, 6.0, 0.1}) {
    viewport.zoom(factor, viewport.toPixel({0, 0, 10}));
    const Vector2d middle = viewport.toPixel({0, 0, 10});
    EXPECT_EQ(viewport.gizmoAt(middle + Vector2d(85, 0)), GizmoAxis::kX);
    EXPECT_EQ(viewport.gizmoAt(middle + Vector2d(105, 0)), GizmoAxis::kNone);
  }
}

TEST_P(ViewportTest, ScaleHandlesUnderThePixel) {
  const Vector3d at = viewport.inViewPlane({400, 300}, {0, 0, 10});
  viewport.setGizmo(Gizmo{at, std::nullopt, GizmoAxis::kNone, GizmoKind::kScale});
  EXPECT_EQ(viewport.gizmoAt({403, 298}), GizmoAxis::kAll);
  EXPECT_EQ(viewport.gizmoAt({484, 302}), GizmoAxis::kX);
  EXPECT_EQ(viewport.gizmoAt({400, 216}), GizmoAxis::kZ);
  EXPECT_EQ(viewport.gizmoAt({440, 260}), GizmoAxis::kNone);
}

TEST_P(ViewportTest, RingsArePickedOnTheirFrontHalf) {
  // From the front and above, the ring about z bulges downwards where it is in front.
  viewport.orbit({0, 70});
  const Vector3d at = viewport.inViewPlane({400, 300}, {0, 0, 10});
  viewport.setGizmo(Gizmo{at, std::nullopt, GizmoAxis::kNone, GizmoKind::kRotate});
  const auto onRing = [&](const Vector3d& towards) {
    const double length =
        74 / (viewport.toPixel(at + 1e-3 * viewport.camera().up) - viewport.toPixel(at)).norm() *
        1e-3;
    return viewport.gizmoAt(viewport.toPixel(at + length * towards.normalized()));
  };
  EXPECT_EQ(onRing({0.4, -0.9, 0}), GizmoAxis::kZ);
  EXPECT_EQ(onRing({0.4, 0.9, 0}), GizmoAxis::kNone);  // behind
  EXPECT_EQ(onRing({0, -0.5, 0.8}), GizmoAxis::kX);
  EXPECT_EQ(onRing({0.6, 0, 0.8}), GizmoAxis::kY);
  EXPECT_EQ(viewport.gizmoAt({400 + 90 * 0.707, 300 + 90 * 0.707}), GizmoAxis::kAll);
  EXPECT_EQ(viewport.gizmoAt({430, 310}), GizmoAxis::kNone);
}

TEST_P(ViewportTest, DraggingAlongALine) {
  const Vector3d through(5, -15, 10);
  const Vector3d direction = Vector3d(1, 0, 2).normalized();
  const Vector3d target = through + 4 * direction;
  const auto found = viewport.onLine(viewport.toPixel(target), through, direction);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - target).norm(), 0, 1e-9);
  const Vector3d sight = viewport.camera().direction;
  if (GetParam()) {
    EXPECT_FALSE(viewport.onLine({100, 100}, through, sight));
  }
}

TEST_P(ViewportTest, WhatLiesUnderThePointerStaysWhileZoomingAndPanning) {
  viewport.orbit({-77, 55});
  const Vector2d pointer(420, 310);
  const Vector3d under = viewport.surfaceAt(pointer).value().position;
  viewport.zoom(2.5, pointer);
  EXPECT_NEAR((viewport.toPixel(under) - pointer).norm(), 0, 1e-8);
  viewport.pan({60, -33}, pointer);
  EXPECT_NEAR((viewport.toPixel(under) - pointer - Vector2d(60, -33)).norm(), 0, 1e-8);
}

TEST_P(ViewportTest, ZoomingInNeverGoesThroughTheSurface) {
  for (int i = 0; i < 300; ++i) {
    viewport.zoom(1.2, {400, 300});
    const auto hit = viewport.surfaceAt({400, 300});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position.y(), -15, 1e-9);
  }
}

TEST_P(ViewportTest, DraggingToTheRightShowsTheLeftSide) {
  viewport.orbit({100, 0});
  EXPECT_GT(viewport.camera().direction.x(), 0.3);
  viewport.orbit({0, 100});
  EXPECT_LT(viewport.camera().direction.z(), -0.3);
}

TEST_P(ViewportTest, CameraRoundTrip) {
  viewport.orbit({140, 70});
  viewport.fit();
  viewport.zoom(2, viewport.toPixel({0, 0, 10}));
  const CameraView saved = viewport.camera();
  EXPECT_NEAR(saved.zoom, 2, 0.2);
  EXPECT_EQ(saved.parallel, GetParam());
  viewport.lookFrom(StandardView::kTop);
  viewport.fit();
  EXPECT_NEAR(viewport.camera().zoom, 1, 1e-9);
  viewport.setCamera(saved);
  EXPECT_NEAR((viewport.camera().direction - saved.direction).norm(), 0, 1e-12);
  EXPECT_NEAR((viewport.camera().up - saved.up).norm(), 0, 1e-12);
  EXPECT_NEAR(viewport.camera().zoom, saved.zoom, 1e-9);
}

TEST_P(ViewportTest, StandardViewsLookAlongTheAxes) {
  const std::vector<std::pair<StandardView, Vector3d>> views{
      {StandardView::kFront, {0, 1, 0}},
      {StandardView::kBack, {0, -1, 0}},
      {StandardView::kLeft, {1, 0, 0}},
      {StandardView::kRight, {-1, 0, 0}},
      {StandardView::kTop, {0, 0, -1}},
      {StandardView::kBottom, {0, 0, 1}},
      {StandardView::kIsometric, Vector3d(-1, 1, -1).normalized()}};
  for (const auto& [view, direction] : views) {
    viewport.lookFrom(view);
    EXPECT_NEAR((viewport.camera().direction - direction).norm(), 0, 1e-12);
  }
}

TEST_P(ViewportTest, ReachesAndSizesFollowThePixelRatio) {
  const Vector2d pixel = viewport.toPixel({20, -15, 20}) + Vector2d(10, -10);
  EXPECT_FALSE(viewport.controlPointAt(pixel));
  viewport.setPixelRatio(2);
  EXPECT_TRUE(viewport.controlPointAt(pixel));
  viewport.setGizmo(Gizmo{{0, 0, 10}, std::nullopt});
  EXPECT_EQ(viewport.gizmoAt(viewport.toPixel({0, 0, 10}) + Vector2d(170, 0)), GizmoAxis::kX);
}

TEST_P(ViewportTest, WrongArraysAreRefused) {
  std::vector<Vector3d> one(1, Vector3d::Zero());
  EXPECT_THROW(viewport.moveBody(one, one), std::invalid_argument);
  EXPECT_THROW(viewport.setMarks({Mark::kLoad}), std::invalid_argument);
  EXPECT_THROW(viewport.moveControlPoints(one), std::invalid_argument);
  EXPECT_THROW(viewport.setHandleStates({HandleState::kHovered}), std::invalid_argument);
  EXPECT_THROW(viewport.setControlNet({one, {{0, 1}}}), std::invalid_argument);
  ViewportBody wrong = body;
  wrong.triangles[0][1] = -1;
  EXPECT_THROW(viewport.setBody(wrong), std::invalid_argument);
  wrong = body;
  wrong.normals.pop_back();
  EXPECT_THROW(viewport.setBody(wrong), std::invalid_argument);
  wrong = body;
  wrong.borders[0][0] = static_cast<int>(body.positions.size());
  EXPECT_THROW(viewport.setBody(wrong), std::invalid_argument);
  EXPECT_THROW(viewport.setPixelRatio(0), std::invalid_argument);
  EXPECT_THROW(viewport.zoom(0, {400, 300}), std::invalid_argument);
  EXPECT_TRUE(viewport.surfaceAt({400, 300}));  // the body from before is still there
}

TEST_P(ViewportTest, WrongContactsAreRefused) {
  const std::vector<double> values(body.positions.size(), 1.0);
  const ScalarField field{"f", "mm", values, ScalarField::Colours::kSequential, {{0, 2}}};
  EXPECT_THROW(viewport.setFieldValues(values, {0, 2}), std::invalid_argument);
  ScalarField wrong = field;
  wrong.values.pop_back();
  EXPECT_THROW(viewport.setField(wrong), std::invalid_argument);
  wrong = field;
  wrong.range.reset();
  EXPECT_THROW(viewport.setField(wrong), std::invalid_argument);
  wrong.range = {2, 1};
  EXPECT_THROW(viewport.setField(wrong), std::invalid_argument);
  viewport.setField(field);
  viewport.setFieldValues(values, {1, 1});
  EXPECT_THROW(viewport.setFieldValues({1.0}, {0, 2}), std::invalid_argument);
  EXPECT_THROW(viewport.setFieldValues(values, {0, std::nan("")}), std::invalid_argument);
  viewport.setBody(body);  // removes the field
  EXPECT_THROW(viewport.setFieldValues(values, {0, 2}), std::invalid_argument);

  ViewportBody ghost = body;
  ghost.normals.pop_back();
  EXPECT_THROW(viewport.setGhost(ghost), std::invalid_argument);
  viewport.setGhost(body);
  viewport.setGhost({});
  EXPECT_THROW(viewport.setLiveArrows({{}, 0}), std::invalid_argument);
  EXPECT_THROW(viewport.setBalls({{{0, 0, 0}, 0}}), std::invalid_argument);
  EXPECT_THROW(viewport.setBalls({{{std::nan(""), 0, 0}, 1}}), std::invalid_argument);
  viewport.setContactRings({{{}, ContactRing::State::kOpen}});
}

TEST_P(ViewportTest, LiveThingsDoNotChangeTheFit) {
  const double zoom = viewport.camera().zoom;
  viewport.setLiveArrows({{{{20, 0, 10}, {1, 0, 0}, ForceArrow::Anchor::kTail, {}, ""}}, 1});
  viewport.setBalls({{{200, 0, 0}, 50}});
  ViewportBody ghost = body;
  for (Vector3d& place : ghost.positions) place *= 10;
  viewport.setGhost(ghost);
  EXPECT_NEAR(viewport.camera().zoom, zoom, 1e-12);
}

TEST_P(ViewportTest, AnEmptyBodyIsNowhere) {
  viewport.setBody({});
  viewport.setControlNet({});
  viewport.fit();
  viewport.zoom(3, {10, 20});
  viewport.orbit({50, 50});
  viewport.pan({5, 5}, Vector2d(100, 100));
  EXPECT_FALSE(viewport.surfaceAt({400, 300}));
  EXPECT_FALSE(viewport.controlPointAt({400, 300}));
  EXPECT_TRUE(viewport.controlPointsIn({0, 0}, {800, 600}).empty());
  EXPECT_TRUE(viewport.toPixel({0, 0, 0}).allFinite());
}

TEST_P(ViewportTest, AWindowWithoutSizeDoesNoHarm) {
  vtkNew<vtkRenderWindow> none;
  none->SetOffScreenRendering(1);
  none->SetSize(0, 0);
  Viewport empty(none);
  empty.setBody(body);
  empty.fit();
  empty.zoom(1.2, {0, 0});
  empty.render();
  EXPECT_TRUE(empty.inViewPlane({0, 0}, {0, 0, 0}).allFinite());
  EXPECT_TRUE(empty.camera().direction.allFinite());
  EXPECT_GT(empty.camera().zoom, 0);
}

TEST(Ground, LiesUnderTheBodyInSteps) {
  const auto under = [](double lowest, double highest) {
    Bounds bounds;
    bounds.add(Vector3d(-25, -25, lowest));
    bounds.add(Vector3d(25, 25, highest));
    return groundLevel(bounds);
  };
  EXPECT_EQ(groundLevel({}), 0);
  EXPECT_EQ(under(0, 40), 0);
  EXPECT_EQ(under(12, 40), 0);
  EXPECT_EQ(under(-25, 25), -26);  // steps of 2 mm for a body of about 87 mm
  EXPECT_EQ(under(-26, 25), -26);
  EXPECT_EQ(under(-26 - 1e-9, 25), -26);
  EXPECT_EQ(under(-26.5, 25), -28);
}

TEST(Ground, SpacingIsRound) {
  EXPECT_EQ(roundedUp(1), 1);
  EXPECT_EQ(roundedUp(1.01), 2);
  EXPECT_EQ(roundedUp(3), 5);
  EXPECT_EQ(roundedUp(7), 10);
  EXPECT_DOUBLE_EQ(roundedUp(0.03), 0.05);
}

TEST(DistinctLines, KeepsOneOfEachPairAndJoinsNeighbours) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0},
                                     {1, 0, 0}, {0, 0, 0}, {1, 1, 0}};
  const std::vector<std::vector<int>> lines{{0, 1, 2}, {3, 4, 5}, {0, 6, 2}, {0, 1}};
  // Three lines end at point 0, two at point 2.
  const std::vector<std::vector<int>> expected{{0, 1, 2, 6, 0}, {0, 1}};
  EXPECT_EQ(distinctLines(lines, points), expected);
}

}  // namespace
}  // namespace palpa::view
