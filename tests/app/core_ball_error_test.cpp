// Stated errors of balls beside sharp edges.
#include <gtest/gtest.h>

#include <string>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/ball_error.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// A ball of 16 mm that presses the side of the cylinder (R = 20 mm, 60 mm high), a millimetre
/// below its rim.
modeling::Project pressedBelowRim(modeling::Engine engine) {
  modeling::Project project = modeling::readProject(PALPA_PROJECTS "/cylinder.json");
  modeling::Touch ball;
  ball.name = "ball";
  ball.kind = modeling::TouchKind::kBall;
  ball.at = {20, 0, 59};
  ball.radius = 16;
  ball.vector = {-1.2, 0, 0};
  project.touches = {ball};
  project.mesh.engine = engine;
  project.mesh.accuracy = 0.03;
  project.mesh.edgeLength = 3.5;
  return project;
}

TouchState::Contact play(const modeling::Project& project) {
  const auto model = buildTouchModel(project, {}, {});
  TouchState state = playTouches(*model, project.touches);
  addErrors(*model, state);
  return state.contacts.front();
}

// One mask carries the pressure there; the force was wrong by 10 %, the stated error 8.6 %.
TEST(BallError, CoversABallBelowARim) {
  const TouchState::Contact coarse = play(pressedBelowRim(modeling::Engine::kSplines));
  const TouchState::Contact fine = play(pressedBelowRim(modeling::Engine::kQuadratic));
  ASSERT_EQ(coarse.patch.size(), 1U);
  const double error = (coarse.force - fine.force).norm() / fine.force.norm();
  EXPECT_GT(error, 0.05);
  EXPECT_GT(*coarse.errorEstimate, error);
  EXPECT_LT(*coarse.errorEstimate, 4 * error);
}

TEST(BallError, IsLargerForOneMaskThatReachesAnEdge) {
  modeling::Project project = pressedBelowRim(modeling::Engine::kSplines);
  project.mesh.accuracy = 0.1;
  const auto model = buildTouchModel(project, {}, {});
  const auto errorAt = [&](double z, double maskRadius, std::size_t masks) {
    return ballPressureError(model->setup(),
                             {{20, 0, z}, Vector3d::UnitX(), 16, maskRadius, 0.1, 1, masks});
  };
  EXPECT_NEAR(errorAt(57, 5, 1), 3 * errorAt(57, 5, 7), 1e-12);
  EXPECT_NEAR(errorAt(40, 5, 1), errorAt(40, 5, 7), 1e-12);
  EXPECT_NEAR(errorAt(57, 2, 1), errorAt(57, 2, 7), 1e-12);
}

}  // namespace
}  // namespace palpa::app
