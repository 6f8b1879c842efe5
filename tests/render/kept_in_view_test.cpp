#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <Eigen/Geometry>

#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/gizmo_handles.h"
#include "app/view/viewport/viewport.h"
#include "modeling/shapes/primitives.h"
#include "tests/render/viewport_scenes.h"

// Arrows and handles that stay in the picture, and pictures with fewer pixels; nothing is drawn.
namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin = 20;

class KeptInView : public testing::TestWithParam<bool> {
 protected:
  KeptInView() {
    camera.setSize(800, 600);
    camera.setParallel(GetParam());
    camera.setDirection({0.1, 1, -0.2}, Vector3d::UnitZ());
    camera.setDistance(120);
  }

  /// The free end as drawn.
  Vector2d shownEnd(const Vector3d& held, const Vector3d& free) const {
    const double share = shareInPicture(camera, held, free, kMargin);
    return camera.toPixel(held + share * (free - held));
  }

  Turntable camera;
};

INSTANTIATE_TEST_SUITE_P(Projections, KeptInView, testing::Bool(), [](const auto& parameter) {
  return parameter.param ? "parallel" : "perspective";
});

TEST_P(KeptInView, AnArrowInThePictureIsWhole) {
  EXPECT_EQ(shareInPicture(camera, {0, 0, 0}, {5, 0, 5}, kMargin), 1);
}

TEST_P(KeptInView, AnArrowThatLeavesEndsAtTheMargin) {
  const Vector3d held = camera.inViewPlane({500, 250}, {0, 0, 0});
  for (const Vector3d& along :
       {Vector3d(0, 0, 100), Vector3d(100, 0, 0), Vector3d(-90, 30, -80), Vector3d(60, -60, 50)}) {
    const Vector2d whole = camera.toPixel(held + along);
    const Vector2d end = shownEnd(held, held + along);
    const Vector2d low(kMargin, kMargin), high(800 - kMargin, 600 - kMargin);
    EXPECT_TRUE((end.array() >= low.array() - 1e-6).all() &&
                (end.array() <= high.array() + 1e-6).all())
        << end.transpose();
    // At one of the edges, not somewhere before.
    const double gap = std::min((end - low).minCoeff(), (high - end).minCoeff());
    EXPECT_NEAR(gap, 0, 1e-6) << whole.transpose();
  }
}

TEST_P(KeptInView, AnArrowTowardsTheEyeEndsBeforeIt) {
  const Vector3d held = camera.inViewPlane({500, 250}, {0, 0, 0});
  const Vector3d towards = held - 300 * camera.axes().forward + Vector3d(1, 0, 0);
  const Vector2d end = shownEnd(held, towards);
  EXPECT_TRUE(end.allFinite());
  EXPECT_TRUE((end.array() > 0).all() && end.x() < 800 && end.y() < 600) << end.transpose();
}

TEST_P(KeptInView, AnArrowOutsideIsLeftAsItIs) {
  const Vector3d outside = camera.inViewPlane({900, 250}, {0, 0, 0});
  EXPECT_EQ(shareInPicture(camera, outside, outside + Vector3d(0, 0, 90), kMargin), 1);
  // Held in the margin and pointing out: a stub stays.
  const Vector3d rim = camera.inViewPlane({799, 250}, {0, 0, 0});
  EXPECT_DOUBLE_EQ(shareInPicture(camera, rim, rim + 90 * camera.axes().right, kMargin), 0.1);
}

TEST_P(KeptInView, TheHandlesOfTheGizmoLieInThePicture) {
  for (const Vector2d& pixel : {Vector2d(795, 300), Vector2d(4, 4), Vector2d(400, 590)}) {
    const Gizmo gizmo{camera.inViewPlane(pixel, {0, 0, 0}), std::nullopt};
    const Gizmo shown = gizmoInPicture(gizmo, camera, 1);
    const auto arrows = gizmoArrows(shown, camera, 1);
    EXPECT_FALSE(arrows.empty());
    for (const GizmoArrow& arrow : arrows) {
      const Vector2d end = camera.toPixel(arrow.end);
      EXPECT_TRUE((end.array() > 0).all() && end.x() < 800 && end.y() < 600) << end.transpose();
    }
  }
  const Gizmo inside{camera.inViewPlane({300, 300}, {0, 0, 0}), std::nullopt};
  EXPECT_EQ(gizmoInPicture(inside, camera, 1).at, inside.at);
  const Gizmo outside{camera.inViewPlane({900, 300}, {0, 0, 0}), std::nullopt};
  EXPECT_EQ(gizmoInPicture(outside, camera, 1).at, outside.at);
}

TEST_P(KeptInView, APictureWithFewerPixelsIsPickedAlike) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(800, 600);
  Viewport viewport(window);
  const modeling::Solid solid = modeling::makeBox({40, 30, 20});
  viewport.setBody(render_tests::viewportBody(solid));
  viewport.setControlNet(render_tests::controlNet(solid));
  viewport.setParallelProjection(GetParam());
  viewport.lookFrom(StandardView::kFront);
  viewport.fit();
  viewport.setGizmo(Gizmo{{0, 0, 10}, std::nullopt});
  const Vector2d pixel = viewport.toPixel({20, -15, 20});
  const double spacing = viewport.gridSpacing();
  const auto point = viewport.controlPointAt(pixel + Vector2d(5, -5));
  ASSERT_TRUE(point);

  window->SetSize(400, 300);
  viewport.setResolution(0.5);
  EXPECT_EQ(viewport.pixelRatio(), 1);
  EXPECT_NEAR((viewport.toPixel({20, -15, 20}) - pixel).norm(), 0, 1e-9);
  EXPECT_EQ(viewport.controlPointAt(pixel + Vector2d(5, -5)), point);
  EXPECT_FALSE(viewport.controlPointAt(pixel + Vector2d(7, -7)));
  EXPECT_EQ(viewport.gizmoAt(viewport.toPixel({0, 0, 10}) + Vector2d(85, 0)), GizmoAxis::kX);
  EXPECT_DOUBLE_EQ(viewport.gridSpacing(), spacing);
  const double zoom = viewport.camera().zoom;
  viewport.fit();
  EXPECT_NEAR(viewport.camera().zoom, zoom, 1e-9);
  EXPECT_THROW(viewport.setResolution(0), std::invalid_argument);
  EXPECT_THROW(viewport.setResolution(2), std::invalid_argument);
}

}  // namespace
}  // namespace palpa::view
