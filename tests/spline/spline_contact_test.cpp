#include <unistd.h>

#include <numbers>

#include "allocation_counter.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/contact/stiffness_map.h"
#include "spline_body.h"
#include "touched_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using Kind = ContactTool::Kind;

constexpr Material kMaterial{0.1, 0.45};
constexpr double kRadius = 25;
const Vector3d kTop(0, 0, kRadius), kSide(kRadius, 0, 0);

/// Cubic splines with elements of 4.9 mm, n = 602, fixed on the lowest of six patches.
SplineTouched& sphere() {
  static auto* shared = [] {
    auto* body = new SplineTouched(modeling::makeSphere(kRadius, 11), FixedBelow{}, kMaterial, 5);
    body->computeAll();
    return body;
  }();
  return *shared;
}

/// The same sphere of fine triangles.
TriangleTouched& fineSphere() {
  static auto* shared = new TriangleTouched(
      fittedMesh(modeling::makeSphere(kRadius, 11), FixedBelow{}, 3.3, 1), kMaterial);
  return *shared;
}

Vector3d forceOf(TouchedBody& body, const ContactTool& tool, const Vector3d& at,
                 const Vector3d& value) {
  ContactSimulation simulation = body.simulation();
  const auto id = simulation.begin(tool, at, value);
  body.settle(simulation);
  EXPECT_TRUE(simulation.converged());
  return simulation.find(id)->force;
}

void expectAgreement(TouchedBody& splines, TouchedBody& triangles, const ContactTool& tool,
                     const Vector3d& at, const Vector3d& value, double tolerance) {
  const Vector3d a = forceOf(splines, tool, at, value), b = forceOf(triangles, tool, at, value);
  std::printf("kind %d at (%g, %g, %g): %.5f and %.5f N, differ by %.2f %%\n",
              static_cast<int>(tool.kind), at[0], at[1], at[2], a.norm(), b.norm(),
              100 * (a - b).norm() / b.norm());
  EXPECT_GT(b.norm(), 0);
  EXPECT_LE((a - b).norm(), tolerance * b.norm());
}

TEST(SplineContact, AgreesWithFineTrianglesOnASphere) {
  for (const Vector3d& at : {kTop, Vector3d(kRadius * Vector3d(1, 0.3, 0.2).normalized())}) {
    const Vector3d outward = at.normalized();
    // Flat triangles are 1.1 % too soft at the top: 1.510 N, where quadratic triangles converge.
    expectAgreement(sphere(), fineSphere(), {Kind::kGrab, 10}, at,
                    -1.5 * outward + Vector3d(0.3, 0.5, 0), 0.02);
    expectAgreement(sphere(), fineSphere(), {Kind::kPush, 10, 0}, at, at - outward, 0.02);
    expectAgreement(sphere(), fineSphere(), {Kind::kPush, 10, 0.5}, at, at - outward, 0.02);
    // One mask, not much wider than the contact, carries the ball: 1.26 and 1.20 N at the top,
    // where six masks of finer splines (n = 2,322) have 1.21 N.
    expectAgreement(sphere(), fineSphere(), {Kind::kBall, 60, 0}, at, at + 58.5 * outward, 0.06);
  }
}

// 1.5262, 1.5279 and 1.5261 N with 498, 866 and 1,538 nodes of quadratic triangles.
TEST(SplineContact, AgreesWithQuadraticTrianglesOnASphere) {
  EXPECT_NEAR(forceOf(sphere(), {Kind::kPush, 10, 0}, kTop, {0, 0, 24}).norm(), 1.527, 0.012);
}

TEST(SplineContact, AgreesWithFineTrianglesOnABox) {
  const modeling::Solid solid = modeling::makeBox({40, 30, 20});
  SplineTouched box(halved(halved(halved(solid))), FixedBelow{}, kMaterial, 5);
  TriangleTouched triangles(fittedMesh(solid, FixedBelow{}, 3.5, 1), kMaterial);
  std::printf("n = %d splines, %d triangle nodes, narrowest %.2f\n", box.splines.coefficientCount(),
              triangles.mesh.nodeCount(),
              box.surface().narrowestMask(box.surface().nearest({3, 2, 20})));
  const Vector3d top(3, 2, 20), rim(19, 2, 20), side(20, 1, 13);
  expectAgreement(box, triangles, {Kind::kGrab, 9}, top, {0.3, 0.2, -1}, 0.015);
  expectAgreement(box, triangles, {Kind::kGrab, 9}, rim, {0.3, 0.2, -1}, 0.03);
  expectAgreement(box, triangles, {Kind::kPush, 9, 0}, side, side - Vector3d(1, 0, 0), 0.015);
  expectAgreement(box, triangles, {Kind::kBall, 100, 0}, top, top + Vector3d(0, 0, 99), 0.03);
  // Masks beyond the sharp edge are masks of the edge, pressed from above. Only two of them side by
  // side are narrower than the contact.
  const Vector3d beside(11, 2, 20);
  expectAgreement(box, triangles, {Kind::kBall, 60, 0}, beside, beside + Vector3d(0, 0, 59), 0.06);
}

// Near the rim of a cylinder's end the mesh is inside the rim: points of the end between them are
// nearest to the mesh's edge, which belongs to the end and to the side.
TEST(SplineContact, NearestPointsBesideASharpEdgeAreOnTheirFace) {
  const SplineTouched cylinder(modeling::makeCylinder(20, 60), FixedBelow{}, kMaterial, 9);
  for (int k = 0; k < 200; ++k) {
    const double angle = 2 * std::numbers::pi * k / 200;
    const Vector3d onEnd(19.9 * std::cos(angle), 19.9 * std::sin(angle), 60);
    EXPECT_LT((cylinder.surface().nearest(onEnd).position - onEnd).norm(), 1e-6)
        << onEnd.transpose();
  }
}

TEST(SplineContact, ComplianceIsSymmetric) {
  BilateralContactSolver solver(sphere().problem(), sphere().surface().slots(), sphere().base());
  for (const Vector3d& at : {kTop, kSide, Vector3d(0, -18, 17), Vector3d(5, 3, 24)})
    solver.addForce(makeContactMask(sphere().surface(), at, 8), {0, 0, 0.1});
  std::printf("reciprocity defect %.1e\n", solver.reciprocityDefect());
  // Two masks overlap: means over the wanted bump are symmetric to second order only.
  EXPECT_LE(solver.reciprocityDefect(), 5e-3);
}

/// Coarse elements with a mask that mostly lies on a support: it moves with its own force, or
/// counts as fixed.
TEST(SplineContact, PlacesWithinASupportFollowOrAreFixed) {
  for (const int points : {5, 6, 7, 8}) {
    SplineTouched body(modeling::makeSphere(25, points), -20, {0.1, 0.45}, 5);
    body.computeAll();
    int grabbed = 0, fixed = 0;
    for (double angle = 0; angle < 0.7; angle += 0.05)
      for (const double turn : {0.0, 0.4, 0.8}) {
        const Vector3d at = 25 * Vector3d(std::sin(angle) * std::cos(turn),
                                          std::sin(angle) * std::sin(turn), -std::cos(angle));
        ContactSimulation simulation = body.simulation();
        const Vector3d value(0.3, -0.2, 0.5);
        simulation.begin({ContactTool::Kind::kGrab, 5}, at, value);
        body.settle(simulation);
        const ContactSimulation::Contact& contact = simulation.contacts().front();
        if (contact.status == ContactSimulation::Status::kFixed) {
          ++fixed;
          continue;
        }
        ++grabbed;
        EXPECT_GT(contact.force.dot(value), 0) << points << " points, " << at.transpose();
        EXPECT_LE((contact.displacement - value).norm(), 1e-6) << at.transpose();
      }
    std::printf("%d points: %d places grabbed, %d fixed\n", points, grabbed, fixed);
    EXPECT_GT(grabbed, 0);
  }
}

TEST(SplineContact, SupportsBalanceIt) {
  BilateralContactSolver solver(sphere().problem(), sphere().surface().slots(), sphere().base());
  solver.addGrab(makeContactMask(sphere().surface(), kTop, 10), Vector3d(0.5, 0.2, -1));
  const Eigen::VectorXd forces = solver.forces();
  const BoundaryField field = solver.field(forces);
  std::vector<int> fixed;
  for (int e = 0; e < sphere().splines.elementCount(); ++e)
    if (sphere().splines.elements()[e].tag == 1) fixed.push_back(e);
  Vector3d reaction = Vector3d::Zero();
  std::vector<double> basis;
  visitSplinePoints(sphere().splines, fixed, 6, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      sphere().splines.evaluateBasis(place, basis);
                      for (std::size_t f = 0; f < basis.size(); ++f)
                        reaction += weight * basis[f] *
                                    field.p.col(0).segment<3>(
                                        3 * sphere().tractions.ofFunction[place.element][f]);
                    });
  std::printf("out of balance by %.2f %%\n", 100 * (reaction + forces).norm() / forces.norm());
  EXPECT_LE((reaction + forces).norm(), 2e-3 * forces.norm());
}

/// Half of what is allowed to triangles (ContactSimulation.TheForceHasNoStepsWhenSliding), over an
/// edge of patches.
TEST(SplineContact, TheForceHasNoStepsWhenSliding) {
  for (const Kind kind : {Kind::kPush, Kind::kBall}) {
    ContactSimulation simulation = sphere().simulation();
    const double radius = kind == Kind::kBall ? 12 : 8;
    const double distance = kind == Kind::kBall ? 25 + 12 - 1.5 : 23.5;
    const auto tool = [&](int k) -> Vector3d {
      const double angle = 0.6 + 0.0002 * k;
      return distance * Vector3d(std::sin(angle), 0.1, std::cos(angle)).normalized();
    };
    const auto id = simulation.begin({kind, radius, 0}, kRadius * tool(0).normalized(), tool(0));
    simulation.step(10);
    double last = simulation.find(id)->force.norm(), least = last, largest = last, jump = 0;
    for (int k = 0; k <= 1500; ++k) {
      simulation.set(id, tool(k));
      simulation.step();
      const double force = simulation.find(id)->force.norm();
      jump = std::max(jump, std::abs(force - last));
      largest = std::max(largest, force);
      least = std::min(least, force);
      last = force;
    }
    std::printf("%s: force %.4f … %.4f N, largest jump %.3f %%\n",
                kind == Kind::kPush ? "finger" : "ball", least, largest, 100 * jump / largest);
    EXPECT_LE(jump, 0.001 * largest);
  }
}

TEST(SplineContact, StepsDoNotAllocate) {
  ContactSimulation simulation = sphere().simulation();
  const auto push = simulation.begin({Kind::kPush, 8, 0.3}, kTop, 24 * Vector3d::UnitZ());
  const auto ball = simulation.begin({Kind::kBall, 10, 0.2}, -kSide, {-34, 0, 0});
  simulation.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0});
  const auto move = [&] {
    for (int k = 0; k <= 60; ++k) {
      const double t = std::sin(2 * std::numbers::pi * k / 60);
      simulation.set(push, 23 * Vector3d(std::sin(0.3 * t), 0, std::cos(0.3 * t)));
      simulation.set(ball, Vector3d(-(34 - t) * std::cos(0.2 * t), 34 * std::sin(0.2 * t), 0));
      simulation.step();
    }
  };
  move();
  move();
  app::test::watchAllocations(::gettid());
  move();
  const long allocations = app::test::allocations();
  app::test::watchAllocations(0);
  EXPECT_EQ(allocations, 0);
}

/// By slots of the mesh, as with triangles, and the same numbers.
TEST(SplineContact, StiffnessMapAgreesWithTriangles) {
  const auto mapped = [](TouchedBody& body, const BoundaryMesh& mesh, double radius) {
    body.computeAll();
    StiffnessMap map(body.surface(), radius);
    map.update(body.columns(), Job{});
    EXPECT_TRUE(map.isComplete());
    const TractionSlots& slots = body.surface().meshSlots();
    // Mean stiffness of a belt around the sphere, which is the same all around.
    double sum = 0, count = 0;
    for (int slot = 0; slot < slots.count(); ++slot) {
      const Vector3d& x = mesh.nodes[slots.slots[slot].node];
      if (x.z() < -20) {
        EXPECT_EQ(map.compliances()[slot], 0);
      }
      if (std::abs(x.z()) > 4) continue;
      EXPECT_GT(map.compliances()[slot], 0);
      sum += 1 / map.compliances()[slot];
      ++count;
    }
    EXPECT_GT(count, 0);
    return sum / count;
  };
  const double a = mapped(sphere(), sphere().mesh, 10);
  const double b = mapped(fineSphere(), fineSphere().mesh, 10);
  std::printf("stiffness %.5f and %.5f N/mm\n", a, b);
  EXPECT_NEAR(a, b, 0.015 * b);
}

}  // namespace
}  // namespace palpa::bem::test
