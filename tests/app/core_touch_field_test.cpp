#include "app/core/live/touch_field.h"
#include "app/core/model/build_touch_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "app/core/live/touch_stepper.h"
#include "app/core/results/touch.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

std::shared_ptr<const TouchableModel> bodyOf(const modeling::Project& project) {
  auto body = std::make_shared<const TouchableModel>(buildTouchModel(project, {}, {}));
  std::vector<int> all(body->surface().places().size());
  std::iota(all.begin(), all.end(), 0);
  body->columns()->compute(all, {});
  return body;
}

/// The sphere, guided at a side as well.
modeling::Project guidedSphere() {
  modeling::Project project = test::clampedSphere(6);
  project.supports.push_back({"guide", modeling::Support::Kind::kRoller,
                              modeling::Region::below(Vector3d::UnitX(), -20), Vector3d::Zero()});
  return project;
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

void expectEqualStates(const TouchState& fast, const TouchState& exact) {
  EXPECT_LE(relative(fast.field.u, exact.field.u), 1e-4);
  EXPECT_LE(relative(fast.field.p, exact.field.p), 1e-4);
  EXPECT_NEAR(fast.energy, exact.energy, 1e-4 * exact.energy);
  ASSERT_EQ(fast.supports.size(), exact.supports.size());
  for (std::size_t k = 0; k < fast.supports.size(); ++k)
    EXPECT_LE((fast.supports[k].resultant.force - exact.supports[k].resultant.force).norm(),
              1e-4 * exact.contacts[0].force.norm());
  EXPECT_NEAR(fast.balance, exact.balance, 1e-4 * exact.contacts[0].force.norm());
}

TEST(TouchField, EqualsTheExactFieldAtRestAndMoving) {
  for (const auto& project : {guidedSphere(), test::clampedCylinder(7)}) {
    const auto body = bodyOf(project);
    const bem::SurfacePoint tip = body->surface().tree().nearest({0, 0, 100});
    TouchStepper stepper(body);
    TouchField field(body);
    TouchSnapshot snapshot;
    std::vector<modeling::Touch> touches{
        {"tip", tip.position, modeling::TouchKind::kGrab, {0, 0.5, -2}, 8.0},
        {"side", {0, 25, 10}, modeling::TouchKind::kForce, {0, -0.2, 0.1}, 7.0}};
    stepper.apply({TouchCommand::Kind::kBegin, 1, {Kind::kGrab, 8}, tip.position, {0, 0.5, -2}});
    stepper.apply({TouchCommand::Kind::kBegin, 2, {Kind::kForce, 7}, {0, 25, 10}, {0, -0.2, 0.1}});
    for (int round = 0; round < 3; ++round) {
      stepper.step();
      stepper.describe(snapshot);
      expectEqualStates(field.describe(snapshot), playTouches(body->model(), touches));
      EXPECT_LE(relative(field.displacements(snapshot), field.field(snapshot).u), 1e-12);
      const Vector3d next(0, 0.5, -2 + 0.3 * round);
      stepper.apply({TouchCommand::Kind::kSet, 1, {}, Vector3d::Zero(), next});
      touches[0].kind = modeling::TouchKind::kGrab;
      touches[0].vector = next;
    }
  }
}

TEST(TouchField, FollowsASlidingBall) {
  const auto body = bodyOf(test::clampedSphere(6));
  TouchStepper stepper(body);
  TouchField field(body);
  TouchSnapshot snapshot;
  stepper.apply({TouchCommand::Kind::kBegin, 1, {Kind::kBall, 12, 0.1}, {0, 0, 25}, {0, 0, 34}});
  for (int k = 0; k < 20; ++k) {
    const double angle = 0.02 * (k / 4);  // some steps at rest
    stepper.apply({TouchCommand::Kind::kSet,
                   1,
                   {},
                   Vector3d::Zero(),
                   34 * Vector3d(std::sin(angle), 0, std::cos(angle))});
    stepper.step();
    stepper.describe(snapshot);
    std::vector<int> nodes;
    std::vector<Vector3d> values;
    stepper.simulation().tractions(nodes, values);
    bem::BoundaryField expected = body->base();
    const auto& firstSlot = body->surface().slots().firstOfNode;
    bem::BoundaryField load{Eigen::VectorXd::Zero(expected.u.rows()),
                            Eigen::VectorXd::Zero(expected.p.rows())};
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int slot = firstSlot[nodes[i]]; slot < firstSlot[nodes[i] + 1]; ++slot)
        load.p.col(0).segment<3>(3 * slot) = values[i];
    const bem::BoundaryField caused = body->model().problem()->solveField(load);
    const bem::BoundaryField& found = field.field(snapshot);
    EXPECT_LE(relative(found.u, expected.u + caused.u), 1e-4);
    EXPECT_LE(relative(found.p, expected.p + caused.p), 1e-4);
  }
}

}  // namespace
}  // namespace palpa::app
