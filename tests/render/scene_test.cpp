#include "app/view/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace palpa::view {
namespace {

SurfaceScene triangle() {
  SurfaceScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

TEST(Scene, AValidOneIsAccepted) {
  EXPECT_NO_THROW(triangle().validate());
}

TEST(Scene, DeformedPositionsAreScaled) {
  SurfaceScene scene = triangle();
  scene.displacements = {{1, 0, 0}, {0, 0, 0}, {0, 0, 2}};
  scene.displacementScale = 3;
  EXPECT_EQ(scene.deformedPositions()[0], Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(scene.deformedPositions()[2], Eigen::Vector3d(0, 1, 6));
}

TEST(Scene, EveryMistakeIsRefused) {
  const std::vector<std::function<void(SurfaceScene&)>> mistakes{
      [](SurfaceScene& s) { s.positions.clear(); },
      [](SurfaceScene& s) { s.positions[1].x() = std::nan(""); },
      [](SurfaceScene& s) { s.triangles[0][2] = 3; },
      [](SurfaceScene& s) { s.triangles[0][0] = -1; },
      [](SurfaceScene& s) { s.displacements.resize(2); },
      [](SurfaceScene& s) {
        s.field = ScalarField{"f", "", {1, 2}, {}, {}};
      },
      [](SurfaceScene& s) {
        s.field = ScalarField{"f", "", {1, 2, std::nan("")}, {}, {}};
      },
      [](SurfaceScene& s) {
        s.normals = {{0, 0, 1}};
      },
      [](SurfaceScene& s) {
        s.meshLines = {{0, 3}};
      },
      [](SurfaceScene& s) { s.supports = {1}; },
      [](SurfaceScene& s) {
        s.contactPatches = {{{0, 0, 0}, 0}};
      },
      [](SurfaceScene& s) { s.camera.direction = s.camera.up; },
      [](SurfaceScene& s) { s.camera.zoom = 0; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    SurfaceScene scene = triangle();
    mistakes[i](scene);
    EXPECT_THROW(scene.validate(), std::invalid_argument) << "mistake " << i;
  }
}

}  // namespace
}  // namespace palpa::view
