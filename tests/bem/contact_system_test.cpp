#include "bem/contact/frictional_contact_solver.h"

#include <gtest/gtest.h>

#include <random>

namespace palpa::bem {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = ContactCondition::Kind;

/// Contacts at random places of an incompressible whole space. Each is a smeared force, so the
/// compliance is positive definite (R. Cortez, The method of regularized Stokeslets, SIAM J. Sci.
/// Comput. 23 (2001) 1204-1225).
struct RandomContacts {
  static constexpr double kCore = 4;  // mm^2
  MatrixXd compliance;
  VectorXd free;
  std::vector<ContactCondition> conditions;

  RandomContacts(int count, double friction, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
    std::vector<Vector3d> places;
    for (int k = 0; k < count; ++k) places.push_back(20 * vector());
    compliance = MatrixXd::Zero(3 * count, 3 * count);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b) {
        const Vector3d r = places[a] - places[b];
        const double squared = r.squaredNorm(), distance = std::sqrt(squared + kCore);
        compliance.block<3, 3>(3 * a, 3 * b) =
            ((squared + 2 * kCore) * Eigen::Matrix3d::Identity() + r * r.transpose()) /
            (distance * distance * distance);
      }
    free = 0.1 * VectorXd::NullaryExpr(3 * count, [&] { return unit(random); });
    for (int k = 0; k < count; ++k) {
      ContactCondition condition;
      const double kind = unit(random);
      condition.kind = kind < -0.6 ? Kind::kGrab : kind < -0.3 ? Kind::kForce : Kind::kUnilateral;
      condition.value = vector();
      condition.normal = vector().normalized();
      condition.friction = friction;
      conditions.push_back(condition);
    }
  }
  VectorXd displacements(const ContactForces& solution) const {
    return free + compliance * solution.forces;
  }
};

/// Checks the contact laws directly.
void expectLaws(const RandomContacts& contacts, const ContactForces& solution) {
  const VectorXd d = contacts.displacements(solution);
  const double size = std::max(solution.forces.norm(), 1e-3);
  for (std::size_t k = 0; k < contacts.conditions.size(); ++k) {
    SCOPED_TRACE(k);
    const auto row = 3 * static_cast<Eigen::Index>(k);
    const ContactCondition& condition = contacts.conditions[k];
    const Vector3d f = solution.forces.segment<3>(row);
    const Vector3d off = d.segment<3>(row) - condition.value;
    if (condition.kind == Kind::kGrab) {
      EXPECT_LE(off.norm(), 1e-7);
    } else if (condition.kind == Kind::kForce) {
      EXPECT_EQ(f, condition.value);
    } else {
      const double pressing = f.dot(condition.normal), gap = off.dot(condition.normal);
      EXPECT_GE(pressing, -1e-8 * size);
      EXPECT_GE(gap, -1e-7);
      EXPECT_LE(std::abs(pressing * gap), 1e-7 * size);
      const Vector3d tangential = f - pressing * condition.normal;
      EXPECT_LE(tangential.norm(), condition.friction * pressing + 1e-7 * size);
      const Vector3d slip = off - gap * condition.normal;
      if (pressing <= 1e-6 * size) continue;  // open: the displacement is arbitrary
      // Friction dissipates the maximum energy: f_t . w = -|f_t| |w|, with the full bound.
      EXPECT_LE(tangential.dot(slip) + tangential.norm() * slip.norm(), 1e-6 * size);
      if (slip.norm() > 1e-6) {
        EXPECT_NEAR(tangential.norm(), condition.friction * pressing, 1e-6 * size);
      }
    }
  }
}

TEST(FrictionalContactSolver, SatisfiesTheLawsWithoutFriction) {
  FrictionalContactSolver system;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const RandomContacts contacts(1 + seed % 20, 0, seed);
    ContactForces solution;
    system.solve(contacts.compliance, contacts.free, contacts.conditions, solution);
    ASSERT_TRUE(solution.converged) << solution.residual;
    expectLaws(contacts, solution);
  }
}

TEST(FrictionalContactSolver, SatisfiesCoulombsLaw) {
  FrictionalContactSolver system;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const RandomContacts contacts(1 + seed % 20, 0.1 + 0.0004 * seed, seed);
    ContactForces solution;
    system.solve(contacts.compliance, contacts.free, contacts.conditions, solution);
    ASSERT_TRUE(solution.converged) << solution.residual;
    EXPECT_LE(solution.iterations, 10);
    expectLaws(contacts, solution);
  }
}

TEST(FrictionalContactSolver, ToolsAtOnePlaceAreSlightlySoft) {
  // The same place twice, with a slightly indefinite compliance as a discretised one may be. One
  // tool prescribes 1 mm inwards, the other 2 mm; a third contact is elsewhere.
  RandomContacts contacts(3, 0, 5);
  contacts.free.setZero();
  auto& d = contacts.compliance;
  for (const int side : {0, 1}) {
    d.middleCols<3>(3) = d.leftCols<3>();
    if (side == 0) d.middleRows<3>(3) = d.topRows<3>();
  }
  d.block<3, 3>(3, 3) = d.block<3, 3>(0, 0) = Eigen::Matrix3d::Identity();
  d.block<3, 3>(0, 3) = d.block<3, 3>(3, 0) = 1.0005 * Eigen::Matrix3d::Identity();
  contacts.conditions[0] = {Kind::kGrab, {0, 0, -1}};
  contacts.conditions[1] = {Kind::kGrab, {0, 0, -2}};
  contacts.conditions[2] = {Kind::kGrab, {0, 0.5, 0}};
  FrictionalContactSolver system;
  ContactForces solution;
  system.solve(d, contacts.free, contacts.conditions, solution);
  EXPECT_FALSE(solution.converged);
  EXPECT_GT(solution.residual, FrictionalContactSolver::kTolerance);
  ASSERT_GT(solution.softness, 0);
  const VectorXd displaced = contacts.displacements(solution);
  // Where the tools contradict each other, the displacement is the mean; elsewhere the law holds.
  const double softness = FrictionalContactSolver::kSharedSoftness;
  EXPECT_NEAR(displaced[2], -1.5 / (1 + softness / 2), 0.01);
  EXPECT_NEAR(displaced[5], -1.5 / (1 + softness / 2), 0.01);
  EXPECT_LE((displaced.tail<3>() - Vector3d(0, 0.5, 0)).norm(), 1e-9);
  EXPECT_LE(solution.forces.norm(), 20);
  EXPECT_LE(solution.iterations, FrictionalContactSolver::kMaxNewton * 4);
}

TEST(FrictionalContactSolver, TheSolutionWithoutFrictionDoesNotDependOnTheStart) {
  FrictionalContactSolver system;
  const RandomContacts contacts(12, 0, 7);
  ContactForces cold, warm;
  system.solve(contacts.compliance, contacts.free, contacts.conditions, cold);
  warm.forces = VectorXd::Constant(36, 3.0);
  system.solve(contacts.compliance, contacts.free, contacts.conditions, warm);
  EXPECT_LE((warm.forces - cold.forces).norm(), 1e-7 * cold.forces.norm());
  // A warm start is already converged.
  system.solve(contacts.compliance, contacts.free, contacts.conditions, warm);
  EXPECT_EQ(warm.iterations, 0);
}

TEST(FrictionalContactSolver, StartsWithPlacesThatMoveAlongTheirNormalsAlone) {
  // As below a ball that suddenly presses into a body at rest. Rounding errors decide about slip.
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomContacts contacts(12, 0, seed);
    contacts.free.setZero();
    for (ContactCondition& condition : contacts.conditions) {
      condition.kind = Kind::kUnilateral;
      condition.value = condition.value.norm() * condition.normal;
    }
    FrictionalContactSolver solver;
    ContactForces solution;
    solver.solve(contacts.compliance, contacts.free, contacts.conditions, solution);
    ASSERT_TRUE(solution.converged) << seed;
    expectLaws(contacts, solution);
  }
}

TEST(FrictionalContactSolver, ReleasesWhenTheToolIsWithdrawn) {
  const MatrixXd compliance = MatrixXd::Identity(3, 3);
  const VectorXd free = VectorXd::Zero(3);
  ContactCondition condition{Kind::kUnilateral, {0, 0, -1}, {0, 0, -1}, 0.5};
  FrictionalContactSolver system;
  ContactForces solution;
  system.solve(compliance, free, {&condition, 1}, solution);
  EXPECT_NEAR(solution.forces[2], -1, 1e-9);
  EXPECT_EQ(solution.statuses[0], ContactStatus::kSticking);
  condition.value = {0, 0, 0.5};
  system.solve(compliance, free, {&condition, 1}, solution);
  EXPECT_EQ(solution.forces.norm(), 0);
  EXPECT_EQ(solution.statuses[0], ContactStatus::kOpen);
}

TEST(FrictionalContactSolver, SlidesWhenDraggedTooFar) {
  // D = 1: dragging by 2 while pressing by 1 requires f_t = 2 > 0.5, so it slips at f_t = 0.5.
  const MatrixXd compliance = MatrixXd::Identity(3, 3);
  const VectorXd free = VectorXd::Zero(3);
  const ContactCondition condition{Kind::kUnilateral, {2, 0, -1}, {0, 0, -1}, 0.5};
  FrictionalContactSolver system;
  ContactForces solution;
  system.solve(compliance, free, {&condition, 1}, solution);
  EXPECT_LE((solution.forces - Vector3d(0.5, 0, -1)).norm(), 1e-9);
  EXPECT_EQ(solution.statuses[0], ContactStatus::kSlipping);
}

TEST(FrictionalContactSolver, ReportsUnsatisfiableLaws) {
  // Not positive definite: a grabbed contact has no solution.
  const MatrixXd compliance = MatrixXd::Zero(3, 3);
  const VectorXd free = VectorXd::Zero(3);
  const ContactCondition condition{Kind::kUnilateral, {0, 0, -1}, {0, 0, -1}, 0};
  FrictionalContactSolver system;
  ContactForces solution;
  MatrixXd indefinite = compliance;
  indefinite.diagonal() << 1e-3, 1e-3, -1e-3;
  system.solve(indefinite, free, {&condition, 1}, solution);
  EXPECT_FALSE(solution.converged);
  EXPECT_GT(solution.residual, FrictionalContactSolver::kTolerance);
  EXPECT_TRUE(solution.forces.allFinite());
}

}  // namespace
}  // namespace palpa::bem
