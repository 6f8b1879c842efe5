#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/base/error.h"
#include "bem/contact/contact_mask.h"
#include "bem/contact/contact_surface.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using namespace verification;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Fixed where the tag is 1.
struct FixedBody {
  std::unique_ptr<QuadraticDiscretisation> on;
  std::unique_ptr<ReferenceProblem> problem;
  std::unique_ptr<ContactSurface> surface;

  explicit FixedBody(std::unique_ptr<QuadraticDiscretisation> body) : on(std::move(body)) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : on->slots().slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    problem = makeDenseReferenceProblem(*on, {conditions, {0.1, 0.45}, {1e-6}});
    surface = on->makeContactSurface(problem->dofs());
  }

  /// Mean displacement under a force along x with a mask there, mm.
  double deflection(const ContactMask& mask) const {
    BoundaryField known{VectorXd::Zero(3 * on->displacementCount()),
                        VectorXd::Zero(3 * on->slots().count())};
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      for (int s = on->slots().firstOfNode[mask.nodes[k]];
           s < on->slots().firstOfNode[mask.nodes[k] + 1]; ++s)
        known.p(3 * s, 0) = mask.traction[k];
    const BoundaryField field =
        problem->solveField(known, ReferenceProblem::Effort::kRefined, Job{});
    return mask.displacement(field.u)(0, 0);
  }
};

FixedBody sphere(int n) {
  return FixedBody(quadratic(
      retagged(sphereMesh(25, n), 1, [](const Vector3d& x) { return x.z() < -15; }), onSphere(25)));
}

TEST(QuadraticContact, PointsFeetAndNormalsAreThoseOfTheCurvedSurface) {
  const FixedBody body = sphere(6);
  for (const Vector3d& direction : {Vector3d(0.3, 0.2, 1), Vector3d(1, 0.9, 0.1)}) {
    const Vector3d at = 25 * direction.normalized();
    const SurfacePoint point = body.surface->nearest(1.1 * at);
    EXPECT_LE((point.position - at).norm(), 5e-3);
    EXPECT_LE((body.surface->normal(point) - direction.normalized()).norm(), 5e-3);
    const SurfacePoint foot = body.surface->foot(1.3 * at, point);
    EXPECT_LE((foot.position - at).norm(), 5e-3);
    EXPECT_LE((body.surface->at(point.triangle, point.weights).position - point.position).norm(),
              1e-9);
  }
}

TEST(QuadraticContact, MasksCarryAUnitForceAndSlideSmoothly) {
  const FixedBody body = sphere(6);
  const auto workspace = body.surface->makeWorkspace();
  ContactMask mask, before;
  double largestJump = 0;
  for (int step = 0; step <= 60; ++step) {
    const double angle = 0.01 * step;
    const Vector3d at = 25 * Vector3d(std::sin(angle), 0.1, std::cos(angle)).normalized();
    const SurfacePoint point = body.surface->nearest(at);
    ASSERT_TRUE(body.surface->makeMask(point, 6, *workspace, mask));
    VectorXd traction = VectorXd::Zero(3 * body.on->slots().count());
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      for (int s = body.on->slots().firstOfNode[mask.nodes[k]];
           s < body.on->slots().firstOfNode[mask.nodes[k] + 1]; ++s)
        traction[3 * s] = mask.traction[k];
    std::vector<int> all(static_cast<std::size_t>(body.on->elementCount()));
    std::iota(all.begin(), all.end(), 0);
    const Resultant sum = body.on->resultant(traction, all);
    EXPECT_NEAR(sum.force.x(), 1, 1e-9);
    double measured = 0;
    Vector3d middle = Vector3d::Zero();
    for (const double weight : mask.measure) measured += weight;
    for (std::size_t k = 0; k < mask.points.size(); ++k)
      middle += mask.pointWeights[k] * mask.points[k];
    EXPECT_NEAR(measured, 1, 1e-9);
    EXPECT_LE((middle - at).norm(), 0.6);  // the surface bends away by 6^2 / (8 · 25)
    if (step > 0) {
      VectorXd change = VectorXd::Zero(body.on->displacementCount());
      double size = 0;
      for (std::size_t k = 0; k < mask.nodes.size(); ++k) {
        change[mask.nodes[k]] += mask.traction[k];
        size = std::max(size, std::abs(mask.traction[k]));
      }
      for (std::size_t k = 0; k < before.nodes.size(); ++k)
        change[before.nodes[k]] -= before.traction[k];
      largestJump = std::max(largestJump, change.lpNorm<Eigen::Infinity>() / size);
    }
    before = mask;
  }
  // A step is 0.25 mm of a mask of 6 mm.
  std::printf("largest change of a coefficient in a step: %.3f\n", largestJump);
  EXPECT_LE(largestJump, 0.12);
}

TEST(QuadraticContact, ComplianceConvergesAndDoesNotDependOnThePlaceInTheMesh) {
  // A block that is fixed on the face x = 30, touched on the face x = 0.
  const auto block = [](int n) {
    return FixedBody(quadratic(boxMesh({0, -25, -25}, {30, 25, 25}, n / 2 + 1, n, n), onFlatFaces));
  };
  const FixedBody coarse = block(8), fine = block(12);
  for (const double y : {0.0, 1.0, 2.3, 3.1, 5.0, 7.0, 9.0}) {
    const Vector3d at(0, y, 0.4 * y);
    const double a = coarse.deflection(makeContactMask(*coarse.surface, at, 13)),
                 b = fine.deflection(makeContactMask(*fine.surface, at, 13));
    std::printf("deflection %.6f and %.6f mm/N\n", a, b);
    EXPECT_NEAR(a, b, 8e-3 * b);
  }
}

TEST(QuadraticContact, SupportedPlacesHaveNoMask) {
  const FixedBody body = sphere(6);
  EXPECT_THROW(makeContactMask(*body.surface, {0, 0, -25}, 3), SolverError);
  // Nodal switching uses middle nodes: corners have functions without a resultant.
  for (int node = 0; node < body.on->displacementCount(); ++node) {
    const int coefficient = body.surface->coefficientAt(node);
    if (coefficient < 0) continue;
    EXPECT_GT(body.on->area(coefficient), 0);
    EXPECT_TRUE(body.problem->dofs().isFree(coefficient));
  }
}

}  // namespace
}  // namespace palpa::bem::test
