#include "bem/contact/contact_simulation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "bem/contact/bilateral_contact_solver.h"
#include "tests/bem/contact_sphere.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = ContactTool::Kind;
using Status = ContactSimulation::Status;
using test::kSide;
using test::kSoft;
using test::kTop;
using test::sphere;

TEST(ContactSimulation, GrabsLikeTheExactSolver) {
  ContactSimulation simulation = sphere().simulation();
  simulation.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
  simulation.begin({Kind::kGrab, 8}, kSide, {1, 0, 0});
  simulation.step();
  ASSERT_TRUE(simulation.converged());
  BilateralContactSolver exact(sphere().problem, sphere().slots, sphere().base);
  exact.addGrab(makeContactMask(*sphere().surface, kTop, 8), Vector3d(0, 0.5, -2));
  exact.addGrab(makeContactMask(*sphere().surface, kSide, 8), Vector3d(1, 0, 0));
  const VectorXd forces = exact.forces();
  // Columns are stored in single precision.
  EXPECT_LE((simulation.contacts()[0].force - forces.head<3>()).norm(), 1e-5 * forces.norm());
  EXPECT_LE((simulation.contacts()[1].force - forces.tail<3>()).norm(), 1e-5 * forces.norm());
}

TEST(ContactSimulation, PushesButDoesNotPull) {
  ContactSimulation simulation = sphere().simulation();
  const auto id = simulation.begin({Kind::kPush, 8, 0}, kTop, {0, 0, 24});
  simulation.step(5);
  const auto pressed = *simulation.find(id);
  EXPECT_LT(pressed.force[2], 0);
  // The mesh normal at the pole deviates from the axis by half a degree.
  EXPECT_NEAR(pressed.displacement[2], -1, 0.02);
  EXPECT_LE(pressed.force.head<2>().norm(), 0.01 * std::abs(pressed.force[2]));
  simulation.set(id, {0, 0, 25.1});
  simulation.step(5);
  EXPECT_EQ(simulation.find(id)->status, Status::kOpen);
  EXPECT_EQ(simulation.find(id)->force.norm(), 0);
}

TEST(ContactSimulation, AFrictionlessToolSlidesWithoutTangentialForce) {
  ContactSimulation simulation = sphere().simulation();
  const auto id = simulation.begin({Kind::kPush, 8, 0}, kTop, {0, 0, 24});
  for (int k = 0; k <= 200; ++k) {
    const double angle = 0.005 * k;
    simulation.set(id, 24 * Vector3d(std::sin(angle), 0, std::cos(angle)));
    simulation.step();
    const auto& contact = *simulation.find(id);
    const Vector3d normal = sphere().surface->normal(contact.point);
    EXPECT_LE((contact.force - normal * normal.dot(contact.force)).norm(),
              1e-6 * contact.force.norm());
  }
  // The contact has followed: it is below the tool.
  const auto& contact = *simulation.find(id);
  EXPECT_NEAR(contact.point.position[0], 25 * std::sin(1.0), 0.6);
}

TEST(ContactSimulation, TheForceHasNoStepsWhenSliding) {
  for (const Kind kind : {Kind::kPush, Kind::kBall}) {
    ContactSimulation simulation = sphere().simulation();
    const double radius = kind == Kind::kBall ? 12 : 8;
    const double distance = kind == Kind::kBall ? 25 + 12 - 1.5 : 23.5;
    const auto id = simulation.begin({kind, radius, 0}, kTop, {0, 0, distance});
    simulation.step(10);
    double last = simulation.find(id)->force.norm(), largest = 0, jump = 0;
    for (int k = 0; k <= 1500; ++k) {
      const double angle = 0.0002 * k;
      simulation.set(id, distance * Vector3d(std::sin(angle), 0, std::cos(angle)));
      simulation.step();
      const double force = simulation.find(id)->force.norm();
      jump = std::max(jump, std::abs(force - last));
      largest = std::max(largest, force);
      last = force;
    }
    // Each step moves the tool by 5 to 7 µm: a force that varied by 10 % along an element would
    // change by 0.02 %.
    EXPECT_LE(jump, 0.002 * largest);
  }
}

TEST(ContactSimulation, FrictionSticksThenSlidesAndDissipatesEnergy) {
  ContactSimulation simulation = sphere().simulation();
  const auto id = simulation.begin({Kind::kPush, 8, 0.3}, kTop, {0, 0, 23});
  simulation.step();
  bool stuck = false, slipped = false;
  for (int k = 0; k <= 100; ++k) {
    simulation.set(id, {0.05 * k, 0, 23});
    simulation.step();
    const auto& contact = *simulation.find(id);
    const double pressing = -contact.force[2];
    stuck = stuck || contact.status == Status::kSticking;
    if (contact.status == Status::kSlipping) {
      slipped = true;
      EXPECT_GT(contact.force[0], 0);  // the tool drags the surface along
    }
    EXPECT_LE(contact.force.head<2>().norm(), 0.3 * pressing * 1.2);
  }
  EXPECT_TRUE(stuck);
  EXPECT_TRUE(slipped);
}

TEST(ContactSimulation, TheContactOfABallGrowsWithDepth) {
  ContactSimulation simulation = sphere().simulation();
  const auto id = simulation.begin({Kind::kBall, 200, 0}, kTop, {0, 0, 225});
  std::size_t masks = 0;
  double force = 0;
  for (const double depth : {0.01, 0.1, 0.5, 1.5, 3.0, 6.0}) {
    simulation.set(id, {0, 0, 225 - depth});
    simulation.step(5);
    const auto& contact = *simulation.find(id);
    EXPECT_GE(contact.patch.size(), masks);
    EXPECT_GT(-contact.force[2], force);
    masks = contact.patch.size();
    force = -contact.force[2];
    for (const auto& patch : contact.patch)
      EXPECT_GE(-patch.force.dot(sphere().surface->normal(patch.point)), 0);
  }
  EXPECT_GE(masks, 6u);  // a ring, wide enough without the middle
}

TEST(ContactSimulation, TheSameStepsGiveTheSameForces) {
  const auto play = [] {
    ContactSimulation simulation = sphere().simulation();
    const auto push = simulation.begin({Kind::kBall, 15, 0.4}, kTop, {0, 0, 39});
    simulation.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0.3});
    std::vector<Vector3d> forces;
    for (int k = 0; k < 50; ++k) {
      simulation.set(push, {0.1 * k, 0.05 * k, 38.5});
      simulation.step();
      for (const auto& contact : simulation.contacts()) forces.push_back(contact.force);
    }
    return forces;
  };
  EXPECT_EQ(play(), play());
}

TEST(ContactSimulation, OtherContactsStayWhenOneEnds) {
  ContactSimulation simulation = sphere().simulation();
  const auto a = simulation.begin({Kind::kBall, 15, 0}, kTop, {0, 0, 39});
  const auto b = simulation.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0.3});
  simulation.step(5);
  simulation.end(a);
  simulation.step();
  ContactSimulation alone = sphere().simulation();
  const auto c = alone.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0.3});
  alone.step();
  EXPECT_LE((simulation.find(b)->force - alone.find(c)->force).norm(),
            1e-12 * alone.find(c)->force.norm());
  EXPECT_EQ(simulation.find(a), nullptr);
}

TEST(ContactSimulation, AContactContinuesInAnotherSimulation) {
  const auto play = [](bool isSwapped) {
    ContactSimulation first = sphere().simulation(), second = sphere().simulation();
    ContactSimulation* touched = &first;
    const auto push = first.begin({Kind::kBall, 15, 0.2}, kTop, {0, 0, 39});
    first.begin({Kind::kPush, 8, 0.3}, {0, 25, 0}, {0, 24, 0});
    first.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0.3});
    std::vector<Vector3d> forces;
    for (int k = 0; k < 60; ++k) {
      if (isSwapped && k == 30) {
        second.takeOver(first);
        EXPECT_TRUE(second.missing().empty());
        touched = &second;
      }
      touched->set(push, {0.1 * k, 0.05 * k, 38.5});
      touched->set(push + 1, {0.05 * k, 23.5, 0.02 * k});
      touched->step();
      for (const auto& contact : touched->contacts()) forces.push_back(contact.force);
    }
    return forces;
  };
  const auto whole = play(false), swapped = play(true);
  double largest = 0, off = 0;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    largest = std::max(largest, whole[k].norm());
    off = std::max(off, (whole[k] - swapped[k]).norm());
  }
  EXPECT_LE(off, 1e-9 * largest);
}

TEST(ContactSimulation, AToolThatSlidesAheadOfItsColumnsKeepsItsForce) {
  GreensColumns few(sphere().problem);
  few.compute(makeContactMask(*sphere().surface, kTop, 8).nodes, Job{});
  ContactSimulation simulation(*sphere().surface, few, sphere().base, kSoft);
  const auto id = simulation.begin({Kind::kPush, 8, 0}, kTop, {0, 0, 24});
  simulation.step(5);
  const double force = simulation.find(id)->force.norm();
  ASSERT_GT(force, 0);
  simulation.set(id, {6, 0, 23.2});
  simulation.step(5);
  EXPECT_FALSE(simulation.missed().empty());
  EXPECT_EQ(simulation.find(id)->status, Status::kSlipping);
  EXPECT_GT(simulation.find(id)->force.norm(), 0.3 * force);
  test::computeMissing(simulation, few);
  EXPECT_TRUE(simulation.missed().empty());
  ContactSimulation whole = sphere().simulation();
  whole.begin({Kind::kPush, 8, 0}, kTop, {6, 0, 23.2});
  whole.step(50);
  EXPECT_LE((simulation.find(id)->force - whole.contacts()[0].force).norm(), 1e-3 * force);
}

TEST(ContactSimulation, WaitsForColumnsAndRefusesHeldPlaces) {
  GreensColumns none(sphere().problem);
  ContactSimulation simulation(*sphere().surface, none, sphere().base, kSoft);
  const auto id = simulation.begin({Kind::kGrab, 8}, kTop, {0, 0, -1});
  const auto fixed = simulation.begin({Kind::kPush, 3}, {0, 0, -25}, {0, 0, -24});
  simulation.step();
  EXPECT_EQ(simulation.find(id)->status, Status::kWaiting);
  EXPECT_EQ(simulation.find(id)->force.norm(), 0);
  EXPECT_EQ(simulation.find(fixed)->status, Status::kFixed);
  none.compute(makeContactMask(*sphere().surface, kTop, 8).nodes, Job{});
  simulation.step();
  EXPECT_EQ(simulation.find(id)->status, Status::kGrabbed);
  EXPECT_LT(simulation.find(id)->force[2], 0);
}

}  // namespace
}  // namespace palpa::bem
