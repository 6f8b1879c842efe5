// Touches of all kinds, played together: what they do is checked against the exact solver.
#include <gtest/gtest.h>

#include <cmath>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "bem/base/error.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "core_projects.h"
#include "modeling/shapes/primitives.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Touch;
using Status = TouchState::Status;

constexpr Vector3d::Scalar kRadius = 25;
const Vector3d kTop{0, 0, kRadius};

std::shared_ptr<const TouchModel> sphere() {
  static const auto model = buildTouchModel(test::clampedSphere(5), {}, {});
  return model;
}

std::shared_ptr<const TouchModel> loadedSphere() {
  static const auto model = [] {
    modeling::Project project = test::clampedSphere(5);
    project.loads = {{"wind", modeling::Bump{{25, 0, 0}, 15, 0.004, {-1, 0, 0.3}}}};
    return buildTouchModel(project, {}, {});
  }();
  return model;
}

/// The top of the sphere as contacts see it: smooth between the nodes.
Vector3d top() {
  const BoundarySetup& setup = sphere()->setup();
  const bem::TriangleContactSurface surface(setup.mesh(), setup.meshSlots(),
                                            sphere()->problem()->dofs());
  return surface.smoothPosition(bem::nearestSurfacePoint(setup.mesh(), kTop));
}

TouchState play(const TouchModel& model, const std::vector<Touch>& touches, int steps = 0) {
  return playTouches(model, touches, steps);
}

Touch push(const Vector3d& at, const Vector3d& by, double friction) {
  return {"push", at, modeling::TouchKind::kPush, by, 8.0, friction};
}

TEST(TouchKinds, APushThatSticksIsAGrab) {
  const Vector3d by{0.4, 0.2, -1.5};
  const TouchState pushed = play(*sphere(), {push(kTop, by, 10)});
  const TouchState grabbed = play(*sphere(), {{"grab", kTop, modeling::TouchKind::kGrab, by, 8.0}});
  const auto& a = pushed.contacts[0];
  const auto& b = grabbed.contacts[0];
  EXPECT_EQ(a.status, Status::kSticking);
  EXPECT_EQ(b.status, Status::kGrabbed);
  EXPECT_LT((a.force - b.force).norm(), 2e-4 * b.force.norm());
  EXPECT_LT((pushed.field.u - grabbed.field.u).norm(), 2e-4 * grabbed.field.u.norm());
  EXPECT_NEAR(a.radius, b.radius, 1e-9);
  ASSERT_TRUE(pushed.path);
  EXPECT_GE(pushed.path->steps, 100);
  EXPECT_LE(pushed.path->change, 1e-6);
  EXPECT_FALSE(grabbed.path);
}

TEST(TouchKinds, AFrictionlessPushOnlyPresses) {
  const TouchState state = play(*sphere(), {push(kTop, {0, 0, -1.5}, 0)});
  const auto& contact = state.contacts[0];
  EXPECT_GT(contact.normalForce(), 0);
  EXPECT_LT(contact.tangentialForce().norm(), 1e-9 * contact.force.norm());
  // The same force from outside does the same.
  const TouchState forced =
      play(*sphere(), {{"force", contact.at, modeling::TouchKind::kForce, contact.force, 8.0}});
  EXPECT_LT((state.field.u - forced.field.u).norm(), 1e-9 * forced.field.u.norm());
  EXPECT_NEAR(forced.contacts[0].displacement.dot(contact.normal), -1.5, 1e-3);
}

TEST(TouchKinds, APushThatSlidesPullsWithItsFrictionAndForgetsTheNumberOfSteps) {
  const auto slide = [&](int steps) {
    return play(*sphere(), {push(kTop, {7, 0, -2}, 0.2)}, steps);
  };
  const TouchState state = slide(0);
  const auto& contact = state.contacts[0];
  EXPECT_EQ(contact.status, Status::kSlipping);
  EXPECT_NEAR(contact.tangentialForce().norm(), 0.2 * contact.normalForce(),
              1e-6 * contact.normalForce());
  EXPECT_GT(contact.at.x(), 2) << "it has slid over the surface";
  EXPECT_LT((contact.tool - top() - Vector3d(7, 0, -2)).norm(), 1e-9);
  for (const int steps : {50, 800}) {
    const TouchState other = slide(steps);
    EXPECT_EQ(other.path->steps, steps);
    EXPECT_LT((other.contacts[0].force - contact.force).norm(), 1e-3 * contact.force.norm());
  }
}

TEST(TouchKinds, WhatSticksIsDraggedAlong) {
  const auto down = play(*sphere(), {push(kTop, {0, 0, -2}, 0.5)}).contacts[0];
  const auto aside = play(*sphere(), {push(kTop, {1, 0, -2}, 0.5)}).contacts[0];
  EXPECT_EQ(down.status, Status::kSticking);
  EXPECT_EQ(aside.status, Status::kSticking);
  EXPECT_NEAR(aside.displacement.x() - down.displacement.x(), 1, 1e-3) << "dragged along";
  EXPECT_GT(aside.force.x(), down.force.x() + 0.1);
}

TEST(TouchKinds, AToolThatLeavesDoesNotPull) {
  for (const Touch& touch : {push(kTop, {0, 0, 1}, 0.5),
                             Touch{"ball", kTop, modeling::TouchKind::kBall, {0, 0, 1}, 8.0}}) {
    const TouchState state = play(*sphere(), {touch});
    EXPECT_EQ(state.contacts[0].status, Status::kOpen);
    EXPECT_EQ(state.contacts[0].force.norm(), 0);
    EXPECT_EQ(state.field.u.norm(), 0);
  }
}

TEST(TouchKinds, ABallPressesFromItsCentreOverItsPatch) {
  const TouchState state =
      play(*sphere(), {{"ball", kTop, modeling::TouchKind::kBall, {0, 0, -2}, 15.0, 0.5}});
  const auto& contact = state.contacts[0];
  EXPECT_EQ(contact.radius, 15);
  EXPECT_EQ(contact.kind, modeling::TouchKind::kBall);
  ASSERT_GE(contact.patch.size(), 1u);
  Vector3d sum = Vector3d::Zero();
  const bem::TriangleContactSurface surface(sphere()->setup().mesh(), sphere()->setup().meshSlots(),
                                            sphere()->problem()->dofs());
  for (const auto& mask : contact.patch) {
    sum += mask.force;
    // What is pressed lies on the ball in the mean; the middles of these wide masks lie deeper.
    const Vector3d moved =
        bem::makeContactMask(surface, mask.point.position, mask.radius).displacement(state.field.u);
    EXPECT_LT((mask.point.position + moved - contact.tool).norm(), 15.1);
    EXPECT_GT((mask.point.position + moved - contact.tool).norm(), 0.9 * 15);
    EXPECT_LT(mask.force.dot(surface.normal(mask.point)), 0);
  }
  EXPECT_LT((sum - contact.force).norm(), 1e-12 * sum.norm());
  EXPECT_GT(contact.patchRadius(), 1);
  EXPECT_LT(contact.patchRadius(), 15);
  EXPECT_LT((contact.tool - top() - Vector3d(0, 0, 15 - 2)).norm(), 1e-9);
  // Deeper: more than in proportion.
  const TouchState deeper =
      play(*sphere(), {{"ball", kTop, modeling::TouchKind::kBall, {0, 0, -4}, 15.0, 0.5}});
  EXPECT_GT(deeper.contacts[0].normalForce(), 2 * contact.normalForce());
}

/// A ball that slides pulls with its friction, however many masks carry it and however many steps
/// the way has.
TEST(TouchKinds, ABallOfManyMasksPullsWithItsFriction) {
  modeling::Project project;
  project.name = "block";
  project.material = {"soft", 0.1, 0.45};
  project.body = modeling::makeBox({60, 60, 30});
  project.supports = {{"base",
                       modeling::Support::Kind::kFixed,
                       {{modeling::HalfSpace{Vector3d::UnitZ(), 0.001}}},
                       Vector3d::Zero()}};
  project.mesh.edgeLength = 4.5;
  project.mesh.engine = modeling::Engine::kTriangles;  // the edges make the masks
  const auto block = buildTouchModel(project, {}, {});
  const auto drag = [&](double friction, int steps) {
    return playTouches(
               *block,
               std::vector<Touch>{
                   {"ball", {-2, 0, 30}, modeling::TouchKind::kBall, {7, 0, -5}, 20.0, friction}},
               steps)
        .contacts[0];
  };
  for (const double friction : {0.1, 0.3}) {
    const auto few = drag(friction, 100), many = drag(friction, 400);
    EXPECT_GE(few.patch.size(), 5u);
    EXPECT_EQ(few.status, Status::kSlipping);
    // Masks press across the bent surface, so the sum differs a little from a flat contact.
    EXPECT_NEAR(few.tangentialForce().x(), friction * few.normalForce(),
                0.05 * friction * few.normalForce());
    EXPECT_LT((few.force - many.force).norm(), 0.01 * many.force.norm());
  }
}

TEST(TouchKinds, APinHoldsWhatLoadsLeaveAndAGrabWhatIsUnloaded) {
  const TouchModel& model = *loadedSphere();
  const Vector3d at{25, 0, 0};
  const Touch pin{"pin", at, modeling::TouchKind::kPin, {0, 0, 0}, 8.0};
  const TouchState pinned = play(model, {pin});
  // Alone it has nothing to hold.
  EXPECT_LT(pinned.contacts[0].force.norm(), 1e-9);
  EXPECT_LT((pinned.field.u - model.rest().field.u).norm(), 1e-9 * model.rest().field.u.norm());
  EXPECT_GT(pinned.contacts[0].displacement.norm(), 0.1);
  const TouchState grabbed =
      play(model, {{"grab", at, modeling::TouchKind::kGrab, {0, 0, 0}, 8.0}});
  EXPECT_GT(grabbed.contacts[0].force.norm(), 0.05);
  EXPECT_LT(grabbed.contacts[0].displacement.norm(), 1e-9);
  // Beside another touch it stays; moved, it is a grab from where loads leave it.
  const Touch press{"press", kTop, modeling::TouchKind::kGrab, {0, 0, -2}, 8.0};
  const TouchState both = play(model, {press, pin});
  EXPECT_LT((both.contacts[1].displacement - pinned.contacts[0].displacement).norm(), 1e-9);
  EXPECT_GT(both.contacts[1].force.norm(), 0.01);
  const TouchState moved = play(model, {{"pin", at, modeling::TouchKind::kPin, {0, 1, 0}, 8.0}});
  EXPECT_LT(
      (moved.contacts[0].displacement - pinned.contacts[0].displacement - Vector3d(0, 1, 0)).norm(),
      1e-9);
}

TEST(TouchKinds, ToolsMeetTheBodyAsLoadsAndHeldTouchesLeaveIt) {
  const TouchModel& model = *loadedSphere();
  const Vector3d at{0, 0, kRadius};
  const std::vector<Touch> held{
      {"grab", {0, 25, 0}, modeling::TouchKind::kGrab, {0, -3, 0}, 8.0},
      {"force", {-25, 0, 0}, modeling::TouchKind::kForce, {0.3, 0, 0.2}, 8.0}};
  // Without a way it just touches.
  std::vector<Touch> touches = held;
  touches.push_back(push(at, {0, 0, 0}, 0.5));
  const TouchState before = play(model, held), touching = play(model, touches);
  EXPECT_LT(touching.contacts[2].force.norm(), 0.005);
  touches.back() = push(at, {0, 0, -1}, 0.5);
  const TouchState pressed = play(model, touches);
  EXPECT_NEAR((pressed.contacts[2].displacement - touching.contacts[2].displacement).z(), -1, 1e-3);
  EXPECT_GT(pressed.contacts[2].normalForce(), 0.5);
  // Grabbed places stay exactly where they are; the report has the order of the touches.
  EXPECT_LT((pressed.contacts[0].displacement - Vector3d(0, -3, 0)).norm(), 1e-12);
  EXPECT_EQ(pressed.contacts[1].force, Vector3d(0.3, 0, 0.2));
  EXPECT_GT((pressed.contacts[0].force - before.contacts[0].force).norm(), 0.01);
  EXPECT_EQ(pressed.contacts[0].name, "grab");
  EXPECT_EQ(pressed.contacts[2].kind, modeling::TouchKind::kPush);
  EXPECT_LT(pressed.relativeBalance, 0.02);
}

TEST(TouchKinds, RefusalsNameTheirReason) {
  const auto messageOf = [&](const std::vector<Touch>& touches) -> std::string {
    try {
      play(*sphere(), touches);
    } catch (const bem::SolverError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(messageOf({push({0, 0, 60}, {0, 0, -1}, 0)}).find("the touch \"push\""),
            std::string::npos);
  EXPECT_NE(messageOf({push({0, 0, -25}, {0, 0, 1}, 0)}).find("support"), std::string::npos);
  std::vector<Touch> balls;
  for (int k = 0; k < 9; ++k)
    balls.push_back(
        {"ball " + std::to_string(k), kTop, modeling::TouchKind::kBall, {0, 0, -1}, 5.0});
  EXPECT_NE(messageOf(balls).find("9 balls; at most 8"), std::string::npos);
}

TEST(TouchKinds, CanBeCancelled) {
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  job.progress = [&](Phase phase, double fraction) {
    if (phase == Phase::kTouch && fraction > 0.3) stop.request_stop();
  };
  const std::vector<Touch> touches{push(kTop, {5, 0, -2}, 0.2)};
  EXPECT_THROW(playTouches(*sphere(), touches, 0, job), Cancelled);
}

}  // namespace
}  // namespace palpa::app
