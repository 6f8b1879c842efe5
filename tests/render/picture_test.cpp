#include "app/view/viewport/picture.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <cmath>
#include <limits>

#include "app/view/scene/arrows.h"
#include "modeling/shapes/primitives.h"
#include "tests/render/viewport_scenes.h"

// Nothing is drawn here: these tests need no display.
namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Picture pictureOfABox() {
  Picture picture;
  picture.body = render_tests::viewportBody(modeling::makeBox({40, 30, 20}));
  return picture;
}

class PictureTest : public testing::Test {
 protected:
  PictureTest() {
    window->SetOffScreenRendering(1);
    window->SetSize(800, 600);
  }
  vtkNew<vtkRenderWindow> window;
  Viewport viewport{window};
};

TEST_F(PictureTest, HasRoomForEverything) {
  Picture picture = pictureOfABox();
  ScalarField field{"Displacement |u|", "mm"};
  field.values.assign(picture.body.positions.size(), 1.0);
  picture.field = field;
  picture.arrows = {{{{20, 0, 10}, {1, 0, 0}, ForceArrow::Anchor::kTail, {}, "1.00 N"}}, 1};
  picture.balls = {{{0, 0, 40}, 20}};
  picture.room = {{0, 0, -30}};
  picture.caption = {"Title", "fixed: base", {}, {"line"}};
  show(picture, viewport);
  const double diagonal = std::hypot(40, 30, 20);
  for (const Vector3d& point : {Vector3d(20 + kFullArrowLength * diagonal, 0, 10),
                                Vector3d(0, 0, 60), Vector3d(0, 0, -30), Vector3d(-20, -15, 0)}) {
    const Vector2d pixel = viewport.toPixel(point);
    EXPECT_GT(pixel.x(), 40);
    EXPECT_LT(pixel.x(), 660) << "beside the colour bar";
    EXPECT_GT(pixel.y(), 60) << "below the title";
    EXPECT_LT(pixel.y(), 520) << "above the caption";
  }
}

TEST_F(PictureTest, ZoomIsRelativeToThat) {
  Picture picture = pictureOfABox();
  const auto width = [&] {
    show(picture, viewport);
    return (viewport.toPixel({20, 0, 10}) - viewport.toPixel({-20, 0, 10})).norm();
  };
  picture.camera = {{0, 1, 0}, {0, 0, 1}, true, 1};
  const double before = width();
  picture.camera.zoom = 2;
  EXPECT_NEAR(width(), 2 * before, 1e-9);
}

TEST_F(PictureTest, MistakesAreRefused) {
  const auto refuses = [&](auto change) {
    Picture picture = pictureOfABox();
    change(picture);
    EXPECT_THROW(show(picture, viewport), std::invalid_argument);
  };
  refuses([](Picture& p) { p.body.triangles[0][2] = 100000; });
  refuses([](Picture& p) { p.positions = {{0, 0, 0}}; });
  refuses([](Picture& p) { p.field = ScalarField{"f", "", {1, 2}}; });
  refuses([](Picture& p) { p.supports = {1.0}; });
  refuses([](Picture& p) { p.balls = {{{0, 0, 0}, 0}}; });
  refuses([](Picture& p) { p.camera.direction.setZero(); });
  refuses([](Picture& p) { p.camera.zoom = 0; });
  EXPECT_THROW(writePicture(pictureOfABox(), {159, 120}, "never-written.png"),
               std::invalid_argument);
}

TEST(Arrows, SmallForcesKeepAShareOfTheLength) {
  const auto length = [](double force, double minShare) {
    const LiveArrows arrows{{{{0, 0, 0}, {force, 0, 0}, {}, {}, ""}}, 4, minShare};
    const auto placed = placeArrows(arrows, 20);
    return placed.empty() ? 0 : (placed[0].tip - placed[0].tail).norm();
  };
  EXPECT_DOUBLE_EQ(length(2, 0.25), 10);
  EXPECT_DOUBLE_EQ(length(0.1, 0.25), 5);
  EXPECT_DOUBLE_EQ(length(1e-9, 0.25), 5);
  EXPECT_EQ(length(0, 0.25), 0);
}

TEST(RegionOfTriangles, EndsAtTheCommonBorder) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}};
  EXPECT_TRUE(regionOfTriangles(triangles, {false, false, false}, 7).empty());
  const std::vector<double> region = regionOfTriangles(triangles, {true, false, false}, 7);
  ASSERT_EQ(region.size(), 7u);
  EXPECT_EQ(region[0], -1);
  for (const int onBorder : {1, 2}) {
    EXPECT_LT(region[onBorder], 0);
    EXPECT_GT(region[onBorder], -0.01);
  }
  for (const int outside : {3, 4, 5, 6}) EXPECT_EQ(region[outside], 1);
}

}  // namespace
}  // namespace palpa::view
