#include "contact_laws.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palpa::app::test {

using bem::ContactStatus;
using Eigen::Vector3d;
using Demand = bem::ContactCondition::Kind;

void expectLaws(const bem::ContactSimulation& simulation) {
  double largest = 1e-3;
  for (int k = 0; k < simulation.maskCount(); ++k)
    largest = std::max(largest, simulation.maskState(k).force.norm());
  const double force = 1e-7 * largest, length = 1e-6 * largest;
  for (const auto& contact : simulation.contacts()) {
    SCOPED_TRACE(testing::Message() << "contact " << contact.id);
    Vector3d sum = Vector3d::Zero();
    bool isPressing = false;
    for (int k = contact.firstMask; k < contact.firstMask + contact.maskCount; ++k) {
      const auto mask = simulation.maskState(k);
      sum += mask.force;
      isPressing = isPressing || !mask.force.isZero(0);
      const auto& law = mask.condition;
      const Vector3d off = mask.displacement - law.value;
      if (law.kind == Demand::kForce) {
        EXPECT_EQ(mask.force, law.value);
      } else if (law.kind == Demand::kGrab) {
        EXPECT_LE(off.norm(), length);
      } else {
        const double pressing = mask.force.dot(law.normal), gap = off.dot(law.normal);
        const Vector3d friction = mask.force - pressing * law.normal;
        const Vector3d slip = off - gap * law.normal;
        const double bound = law.friction * pressing;
        EXPECT_GE(pressing, 0);
        EXPECT_GE(gap, -length);
        EXPECT_LE(friction.norm(), bound + force);
        if (mask.status == ContactStatus::kOpen) {
          EXPECT_TRUE(mask.force.isZero(0));
          continue;
        }
        EXPECT_LE(gap, length);
        if (mask.status == ContactStatus::kSticking) {
          EXPECT_LE(slip.norm(), length);
        } else {
          ASSERT_EQ(mask.status, ContactStatus::kSlipping);
          EXPECT_NEAR(friction.norm(), bound, force);
          EXPECT_LE(friction.dot(slip) + friction.norm() * slip.norm(),
                    force * slip.norm() + 1e-12);
        }
      }
    }
    EXPECT_LE((contact.force - sum).norm(), force);
    if (contact.status == TouchSnapshot::Status::kOpen) {
      EXPECT_FALSE(isPressing);
    }
  }
}

void measureEquilibrium(const TouchStepper& stepper, TouchField& field, double radius,
                        Equilibrium& largest) {
  TouchSnapshot snapshot;
  stepper.describe(snapshot);
  const TouchState state = field.describe(snapshot);
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  double size = 1e-3, moved = 0.1;
  const auto& simulation = stepper.simulation();
  for (int k = 0; k < simulation.maskCount(); ++k) {
    const auto mask = simulation.maskState(k);
    moved = std::max(moved, mask.displacement.norm());
    if (mask.force.isZero(0)) continue;
    Vector3d middle = Vector3d::Zero();
    for (std::size_t i = 0; i < mask.mask.points.size(); ++i)
      middle += mask.mask.pointWeights[i] * mask.mask.points[i];
    force += mask.force;
    moment += middle.cross(mask.force);
    size += mask.force.norm();
  }
  for (const auto& support : state.supports) {
    force += support.resultant.force;
    moment += support.resultant.moment;
  }
  largest.force = std::max(largest.force, force.norm() / size);
  largest.moment = std::max(largest.moment, moment.norm() / (size * radius));
  for (const auto& contact : simulation.contacts())
    for (int k = contact.firstMask; k < contact.firstMask + contact.maskCount; ++k) {
      const auto mask = simulation.maskState(k);
      if (mask.mask.nodes.empty() || mask.status == ContactStatus::kOpen ||
          (mask.force.isZero(0) && mask.condition.kind == Demand::kForce))
        continue;
      const Vector3d off = mask.mask.displacement(state.field.u) - mask.displacement;
      largest.position = std::max(largest.position, off.norm() / moved);
    }
}

}  // namespace palpa::app::test
