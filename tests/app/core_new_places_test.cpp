// Large models answer new places before their columns.
#include <gtest/gtest.h>

#include <cmath>

#include "app/core/live/touch_field.h"
#include "app/core/results/touch.h"
#include "bem/compressed/make_problem.h"
#include "tests/bem/roughly_solved.h"
#include "touch_loop_sphere.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using test::await;
using test::hasForce;
using test::isComplete;
using test::kSide;
using test::kTop;
using test::largerSphere;
using test::sphere;

TEST(NewPlaces, LargeModelsAnswerAGrabbedPlaceBeforeItsColumns) {
  TouchLoop::Options options;
  options.computesAll = false;
  options.answersPlacesFrom = 0;
  TouchLoop loop(options);
  const auto number = loop.setModel(sphere());
  const Vector3d pull(0, 0.5, -2);
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, pull);
  const TouchSnapshot snapshot = await(loop, hasForce(id));
  EXPECT_EQ(snapshot.columnsReady, 0);
  const modeling::Touch touch{"exact", kTop, modeling::TouchKind::kGrab, pull, 8.0};
  const TouchState exact = playTouches(*sphere(), std::span(&touch, 1));
  EXPECT_LE((snapshot.find(id)->force - exact.contacts[0].force).norm(),
            1e-4 * exact.contacts[0].force.norm());
  TouchField field(loop.model(number));
  EXPECT_LE((field.displacements(snapshot) - exact.field.u).norm(), 1e-4 * exact.field.u.norm());
  const TouchId push = loop.begin({Kind::kPush, 6, 0}, kSide, {24, 0, 0});
  await(loop, hasForce(push));
  // The many masks of a ball need columns, also beside places that do not.
  const TouchId ball = loop.begin({Kind::kBall, 6, 0}, -kSide, {-30, 0, 0});
  EXPECT_GT(await(loop, hasForce(ball)).columnsReady, 0);
  // An edited model takes over when it has an answer.
  const auto edited = loop.setModel(largerSphere(1.01));
  loop.end(push);
  loop.end(ball);
  const TouchSnapshot after = await(loop, [edited](const TouchSnapshot& now) {
    return now.model == edited && now.contactCount == 1;
  });
  EXPECT_GT(after.find(id)->force.norm(), 0.9 * snapshot.find(id)->force.norm());
}

/// The sphere with rough solutions that are 5 % wrong, made for each test.
std::shared_ptr<const TouchModel> roughlySolvedSphere() {
  BuildOptions options;
  options.makeProblem = [](const bem::Discretisation& discretisation,
                           const bem::ProblemInputs& inputs, const Job& job,
                           bem::ReferenceProblemTimes* times) {
    return std::make_unique<bem::RoughlySolved>(
        bem::makeReferenceProblem(discretisation, inputs, job, times));
  };
  return buildTouchModel(test::clampedSphere(6), options, {});
}

TEST(NewPlaces, NewPlacesOfLargeModelsAreRoughAtFirst) {
  const auto model = roughlySolvedSphere();
  const auto& problem = dynamic_cast<const bem::RoughlySolved&>(*model->problem());
  TouchLoop::Options options;
  options.answersPlacesFrom = 0;
  TouchLoop loop(options);
  loop.setModel(model);
  const Vector3d pull(0, 0.5, -2);
  const modeling::Touch touch{"exact", kTop, modeling::TouchKind::kGrab, pull, 8.0};
  const TouchState exact = playTouches(*sphere(), std::span(&touch, 1));
  const Vector3d force = exact.contacts[0].force;
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, pull);
  await(loop, hasForce(id));
  EXPECT_EQ(problem.roughCount(), 1);
  // The other thread improves it.
  await(loop, [&](const TouchSnapshot& snapshot) {
    const auto* contact = snapshot.find(id);
    return contact && (contact->force - force).norm() <= 1e-4 * force.norm();
  });
  EXPECT_EQ(problem.roughCount(), 1);
}

TEST(NewPlaces, BallsOnLargeModelsAreRoughAtFirst) {
  const bem::ContactTool ball{Kind::kBall, 8, 0};
  const Vector3d value(0, 0, 31);
  Vector3d expected = Vector3d::Zero();
  {
    TouchLoop loop;
    const auto number = loop.setModel(sphere());
    const TouchId id = loop.begin(ball, kTop, value);
    await(loop, hasForce(id));
    expected = await(loop, isComplete(number)).find(id)->force;
  }
  const auto model = roughlySolvedSphere();
  TouchLoop::Options options;
  options.answersPlacesFrom = 0;
  TouchLoop loop(options);
  loop.setModel(model);
  const TouchId id = loop.begin(ball, kTop, value);
  await(loop, hasForce(id));
  EXPECT_GT(dynamic_cast<const bem::RoughlySolved&>(*model->problem()).roughCount(), 0);
  await(loop, [&](const TouchSnapshot& snapshot) {
    const auto* contact = snapshot.find(id);
    return contact && (contact->force - expected).norm() <= 1e-3 * expected.norm();
  });
}

TEST(NewPlaces, NobodyImprovesRoughPlacesWithoutTheOtherThread) {
  const auto model = roughlySolvedSphere();
  TouchLoop::Options options;
  options.answersPlacesFrom = 0;
  options.computesAll = false;
  TouchLoop loop(options);
  loop.setModel(model);
  await(loop, hasForce(loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -1})));
  EXPECT_EQ(dynamic_cast<const bem::RoughlySolved&>(*model->problem()).roughCount(), 0);
}

TEST(NewPlaces, NewPlacesInterruptTheColumnsOfOthers) {
  TouchLoop::Options options;
  options.answersPlacesFrom = 0;
  TouchLoop loop(options);
  const auto number = loop.setModel(sphere());
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.7 * k;
    const TouchId id = loop.begin({Kind::kGrab, 6},
                                  25 * Vector3d(std::cos(angle), std::sin(angle), 0), {0, 0, 0.1});
    await(loop, hasForce(id));
    loop.end(id);
  }
  EXPECT_TRUE(loop.status().error.empty());
  await(loop, isComplete(number));
}

}  // namespace
}  // namespace palpa::app
