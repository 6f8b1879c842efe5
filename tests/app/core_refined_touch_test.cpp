// A touch on finer and finer meshes until the forces have the wished error.
#include "app/core/results/refined_touch.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "app/core/results/error_estimate.h"
#include "app/core/results/finer_mesh.h"
#include "app/core/results/touch.h"
#include "tests/app/core_projects.h"

namespace palpa::app {
namespace {

using End = RefinedTouch::End;

/// A sphere of quadratic triangles, pressed at its side.
modeling::Project sphere() {
  modeling::Project project = test::clampedSphere(6);
  project.mesh.engine = modeling::Engine::kQuadratic;
  modeling::Touch touch;
  touch.name = "side";
  touch.at = {25, 0, 0};
  touch.radius = 8;
  touch.vector = {-1, 0, 0};
  project.touches = {touch};
  return project;
}

TouchState play(const TouchModel& model, const modeling::Project& project, const Job& job) {
  TouchState state = playTouches(model, project.touches, 0, job);
  addErrors(model, state, job);
  return state;
}

/// Refined to two thirds of the error that the project's mesh gives.
struct Refined {
  double first = 0;
  ErrorGoal goal;
  RefinedTouch touch;
};
const Refined& refined() {
  static const Refined refined = [] {
    Refined made;
    const RefinedTouch first = refineTouch(sphere(), {0.999, 600, 1}, {}, play, {});
    EXPECT_EQ(first.steps.size(), 1u);
    EXPECT_EQ(first.end, End::kReached);
    made.first = first.steps[0].error;
    made.goal = {made.first / 1.5, 600};
    made.touch = refineTouch(sphere(), made.goal, {}, play, {});
    return made;
  }();
  return refined;
}

TEST(RefinedTouch, RefinesUntilTheErrorIsReached) {
  const auto& [first, goal, touch] = refined();
  ASSERT_EQ(touch.end, End::kReached) << touch.steps.back().error << " of " << goal.error;
  ASSERT_GE(touch.steps.size(), 2u);
  EXPECT_EQ(touch.steps[0].error, first);
  for (std::size_t k = 1; k < touch.steps.size(); ++k) {
    EXPECT_GT(touch.steps[k].coefficients, touch.steps[k - 1].coefficients);
    EXPECT_GT(touch.steps[k - 1].error, goal.error);
  }
  const RefinementStep& last = touch.steps.back();
  EXPECT_LE(last.error, goal.error);
  EXPECT_EQ(touch.project.mesh.edgeLength, last.mesh.edgeLength);
  EXPECT_LT(last.mesh.edgeLength, sphere().mesh.edgeLength);
  EXPECT_EQ(touch.model->report().nodes, last.nodes);
  EXPECT_EQ(touch.state.forceErrorEstimate, last.error);
}

/// The error is true, too: against splines, another engine with another mesh.
TEST(RefinedTouch, TheForceIsRightToTheReachedError) {
  const auto& [first, goal, touch] = refined();
  modeling::Project splines = sphere();
  splines.mesh.engine = modeling::Engine::kSplines;
  splines.mesh.accuracy = 0.002;
  const TouchState exact = play(*buildTouchModel(splines, {}, {}), splines, {});
  const Eigen::Vector3d force = exact.contacts[0].force;
  EXPECT_LT((touch.state.contacts[0].force - force).norm(),
            (goal.error + exact.forceErrorEstimate.value()) * force.norm());
}

TEST(RefinedTouch, EndsWhenTimeMeshesOrMemoryDo) {
  ErrorGoal goal;
  goal.error = 1e-9;
  goal.maxMeshes = 2;
  goal.seconds = 600;
  const RefinedTouch two = refineTouch(sphere(), goal, {}, play, {});
  EXPECT_EQ(two.steps.size(), 2u);
  EXPECT_EQ(two.end, End::kMeshes);

  goal.seconds = 1e-6;
  const RefinedTouch late = refineTouch(sphere(), goal, {}, play, {});
  EXPECT_EQ(late.steps.size(), 1u);
  EXPECT_EQ(late.end, End::kTime);

  goal.seconds = 600;
  BuildOptions options;
  options.memoryLimit = 1.3 * late.model->report().memory;
  const RefinedTouch full = refineTouch(sphere(), goal, options, play, {});
  EXPECT_EQ(full.steps.size(), 1u);
  EXPECT_EQ(full.end, End::kMemory);
}

/// A finer mesh may take much longer than expected.
TEST(RefinedTouch, DoesNotWaitForAMeshBeyondTheTime) {
  ErrorGoal goal;
  goal.error = 1e-9;
  int plays = 0;
  double first = 0;
  const auto slow = [&](const TouchModel& model, const modeling::Project& project, const Job& job) {
    if (++plays == 1) return play(model, project, job);
    while (true) {
      job.throwIfCancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  for (goal.seconds = 1; plays < 2 && goal.seconds < 1000; goal.seconds *= 2) {
    plays = 0;
    const RefinedTouch touch = refineTouch(sphere(), goal, {}, slow, {});
    EXPECT_EQ(touch.steps.size(), 1u);
    EXPECT_EQ(touch.end, End::kTime);
    first = touch.steps[0].error;
  }
  EXPECT_EQ(plays, 2);
  EXPECT_GT(first, 0);
}

TEST(RefinedTouch, KeepsWhatItHasIfAFinerMeshFails) {
  ErrorGoal goal;
  goal.error = 1e-9;
  goal.seconds = 600;
  int plays = 0;
  const auto failing = [&](const TouchModel& model, const modeling::Project& project,
                           const Job& job) {
    if (++plays == 2) throw std::runtime_error("the second mesh is bad");
    return play(model, project, job);
  };
  const RefinedTouch touch = refineTouch(sphere(), goal, {}, failing, {});
  EXPECT_EQ(touch.end, End::kFailed);
  EXPECT_EQ(touch.reason, "the second mesh is bad");
  EXPECT_EQ(touch.steps.size(), 1u);
  EXPECT_EQ(touch.model->report().nodes, touch.steps[0].nodes);
  EXPECT_EQ(touch.state.forceErrorEstimate, touch.steps[0].error);
  // The first mesh has nothing to fall back on.
  plays = 1;
  EXPECT_THROW(refineTouch(sphere(), goal, {}, failing, {}), std::runtime_error);
}

TEST(RefinedTouch, TakesTheMeshWithTheSmallestError) {
  const ErrorGoal goal{0.095, 600, 3};
  // The second mesh is the best one.
  int plays = 0;
  const auto worse = [&](const TouchModel& model, const modeling::Project& project,
                         const Job& job) {
    TouchState state = play(model, project, job);
    state.forceErrorEstimate = std::array{0.15, 0.1, 0.12}.at(plays++);
    return state;
  };
  const RefinedTouch touch = refineTouch(sphere(), goal, {}, worse, {});
  EXPECT_EQ(touch.end, End::kMeshes);
  ASSERT_EQ(touch.steps.size(), 3u);
  EXPECT_EQ(touch.taken, 1u);
  EXPECT_EQ(touch.model->report().nodes, touch.steps[1].nodes);
  EXPECT_EQ(touch.project.mesh.edgeLength, touch.steps[1].mesh.edgeLength);
  EXPECT_EQ(touch.state.forceErrorEstimate, 0.1);
  EXPECT_LT(touch.steps[2].mesh.edgeLength, touch.steps[1].mesh.edgeLength);
}

TEST(RefinedTouch, CanBeCancelledBetweenMeshes) {
  ErrorGoal goal;
  goal.error = 1e-9;
  goal.seconds = 600;
  std::stop_source source;
  Job job;
  job.stop = source.get_token();
  const auto once = [&](const TouchModel& model, const modeling::Project& project,
                        const Job& given) {
    TouchState state = play(model, project, given);
    source.request_stop();
    return state;
  };
  EXPECT_THROW(refineTouch(sphere(), goal, {}, once, job), Cancelled);
}

TEST(FinerMesh, LengthsHaveThreeDigitsAndAreNeverTooLong) {
  modeling::MeshSettings mesh;
  mesh.edgeLength = 3;
  EXPECT_DOUBLE_EQ(finerMesh(mesh, false, 1.7).edgeLength, 1.76);
  mesh.elementLength = 10;
  EXPECT_DOUBLE_EQ(*finerMesh(mesh, true, 3).elementLength, 3.33);
  mesh.elementLength.reset();
  mesh.splineDensity = 2;
  EXPECT_DOUBLE_EQ(finerMesh(mesh, true, 1.1111).splineDensity, 2.23);
  EXPECT_DOUBLE_EQ(finerMesh(mesh, true, 1e6).splineDensity,
                   modeling::MeshSettings::kMaxSplineDensity);
}

TEST(FinerMesh, OrderIsThatOfTheErrorsUnlessTheySayNothing) {
  EXPECT_NEAR(observedOrder(0.08, 0.01, 2, false), 3, 1e-12);
  EXPECT_DOUBLE_EQ(observedOrder(0.01, 0.02, 2, false), 1);
  EXPECT_DOUBLE_EQ(observedOrder(0.9, 1e-9, 2, true), 6);
  EXPECT_DOUBLE_EQ(observedOrder(0.08, 0.01, 1.01, false), usualOrder(false));
}

TEST(FinerMesh, RefinementIsTheFactorOfTheLengths) {
  for (const bool hasSplines : {false, true}) {
    modeling::MeshSettings mesh;
    mesh.edgeLength = 4;
    EXPECT_NEAR(refinement(mesh, finerMesh(mesh, hasSplines, 2), hasSplines), 2, 0.01);
    mesh.elementLength = 8;
    EXPECT_NEAR(refinement(mesh, finerMesh(mesh, hasSplines, 2), hasSplines), 2, 0.01);
  }
}

}  // namespace
}  // namespace palpa::app
