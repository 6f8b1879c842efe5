// Tools dragged once around the sphere: the effect of the discretisation on the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/core/model/build_touch_model.h"
#include "bench/touch_slide.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Kind = bem::ContactTool::Kind;
using modeling::Engine;

/// Largest changes over 0.1 mm, relative to the largest force.
struct Jumps {
  double finger, ball;
};

/// The direction turns by 0.23 degrees per step, which is 0.4 % of a force.
class TouchSlide : public testing::TestWithParam<std::pair<Engine, Jumps>> {};

TEST_P(TouchSlide, TheForceHasNoStepsAroundTheSphere) {
  const auto& [engine, limits] = GetParam();
  modeling::Project project = test::clampedSphere(3);
  project.mesh.engine = engine;
  project.mesh.elementLength = 7;
  const auto body = std::make_shared<TouchableModel>(buildTouchModel(project, {}, {}));
  body->columns()->compute(
      body->columns()->nodesNear(body->surface().places(), Eigen::Vector3d::Zero()), {});
  std::printf("n = %d\n", body->surface().dofs().nodeCount());
  // As it came out with friction, too (palpa-touch-bench).
  for (const bool isBall : {false, true}) {
    const bem::ContactTool tool{isBall ? Kind::kBall : Kind::kPush, isBall ? 10.0 : 6.0, 0};
    const bench::Slide slide = bench::dragAround(body, tool, 1.5);
    const double largest = slide.largestForce();
    std::printf("%s: jumps of %.2f %%, of its magnitude %.2f %%\n", isBall ? "ball" : "finger",
                100 * slide.largestJump() / largest, 100 * slide.largestMagnitudeJump() / largest);
    EXPECT_LE(slide.largestJump(), (isBall ? limits.ball : limits.finger) * largest);
    for (const auto& sample : slide.samples) ASSERT_TRUE(sample.isConverged);
  }
}

/// Of nets as the window makes them, for touches that are narrower than these can carry: elements,
/// and with them masks, are of other sizes from patch to patch.
TEST(TouchSlide, TheForceHasNoKinksWherePatchesMeet) {
  modeling::Project project = test::clampedSphere(3);
  project.mesh.engine = Engine::kSplines;
  const auto body = std::make_shared<TouchableModel>(buildTouchModel(project, {}, {}));
  body->columns()->compute(
      body->columns()->nodesNear(body->surface().places(), Eigen::Vector3d::Zero()), {});
  for (const double radius : {3.0, 6.0}) {
    const bench::Slide slide = bench::dragAround(body, {Kind::kPush, radius, 0}, 1.5);
    double narrowest = INFINITY, widest = 0;
    for (const auto& sample : slide.samples) {
      narrowest = std::min(narrowest, sample.radius);
      widest = std::max(widest, sample.radius);
    }
    std::printf("finger %g mm, masks of %.2f … %.2f mm: kinks of %.3f %%\n", radius, narrowest,
                widest, 100 * slide.largestKink() / slide.largestForce());
    if (radius < 4) {
      EXPECT_GT(widest, 1.05 * narrowest);
    }
    EXPECT_LE(slide.largestKink(), 8e-4 * slide.largestForce());
  }
}

// The solid's own faces meet at an angle of 0.12 degrees beside the corners of the cube that its
// patches come from; triangles with their averaged normals smooth that away, but the contact of a
// ball turns with each of their faces.
// Splines: where the path comes within two elements of the support's border, masks consist of
// functions with roots.
INSTANTIATE_TEST_SUITE_P(Engines, TouchSlide,
                         testing::Values(std::pair(Engine::kTriangles, Jumps{0.005, 0.009}),
                                         std::pair(Engine::kSplines, Jumps{0.018, 0.038})),
                         [](const auto& tested) {
                           return tested.param.first == Engine::kSplines ? "Splines" : "Triangles";
                         });

}  // namespace
}  // namespace palpa::app
