#include <gtest/gtest.h>

#include <cmath>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/model/traction_projection.h"
#include "bem/triangle/results.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Sphere of radius 25 mm, fixed below z = -20 mm, with bump loads.
struct LoadedSphere {
  BoundaryMesh mesh;
  TractionSlots slots;
  std::vector<SlotCondition> conditions;
  std::unique_ptr<ReferenceProblem> problem;

  explicit LoadedSphere(int cells)
      : mesh(verification::retagged(verification::sphereMesh(25, cells), 1,
                                    [](const Vector3d& x) { return x[2] < -20; })),
        slots(mesh) {
    for (const auto& slot : slots.slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    problem =
        makeDenseReferenceProblem(mesh, slots, {conditions, {0.1, 0.45}, {}, Precision::kDouble});
  }
  VectorXd load(const Vector3d& center, const Vector3d& direction) const {
    constexpr double kRadius = 12;
    return projectTraction(mesh, slots,
                           {verification::allTriangles(mesh),
                            [&](const Vector3d& x, const Vector3d&) {
                              const double s = (x - center).squaredNorm() / (kRadius * kRadius);
                              const double height = s < 1 ? (1 - s) * (1 - s) : 0;
                              return Vector3d(height * direction);
                            },
                            kRadius});
  }
  BoundaryField solve(const VectorXd& traction) const {
    BoundaryConditions given(mesh, slots);
    given.ofSlot = conditions;
    given.traction = traction;
    return problem->solveField(problem->dofs().knownField(given));
  }
  /// ∫ p.u dΓ of the tractions of one state and the displacements of another.
  double work(const VectorXd& p, const VectorXd& u) const {
    return 2 * strainEnergy(mesh, slots, u, p);
  }
};

const Vector3d kTop(0, 0, 25), kSide(25, 0, 0), kPush(0, 0, -0.003), kPull(0.002, 0.001, 0);

TEST(Energy, IsHalfTheWorkOfTheLoads) {
  const LoadedSphere sphere(9);
  const VectorXd load = sphere.load(kTop, kPush);
  const BoundaryField field = sphere.solve(load);
  // The support does not move, so its tractions do no work: both sums are the same integral.
  const double energy = strainEnergy(sphere.mesh, sphere.slots, field.u.col(0), field.p.col(0));
  EXPECT_GT(energy, 0);
  EXPECT_NEAR(energy, 0.5 * sphere.work(load, field.u.col(0)), 1e-12 * energy);
}

TEST(Energy, OfAUniformTensionIsExact) {
  // Rod of 4 x 3 x 2 mm, E = 0.1 MPa, 0.002 MPa along x, on three rollers: sigma^2 / 2E times the
  // volume.
  const Material material{0.1, 0.3};
  const double strain = 0.02;
  const auto exact = verification::linearField(
      Vector3d(strain, -0.3 * strain, -0.3 * strain).asDiagonal(), Vector3d::Zero(), material);
  const verification::SolvedBody body(
      verification::boxMesh({0, 0, 0}, {4, 3, 2}, 4, 3, 2), material, exact,
      [](int tag) { return tag % 2 == 0 ? SlotCondition::kRoller : SlotCondition::kTraction; });
  EXPECT_NEAR(strainEnergy(body.mesh, body.slots, body.field.u.col(0), body.field.p.col(0)),
              0.002 * 0.002 / 0.2 * 24, 1e-8 * 4.8e-4);  // as the patch test
}

/// Betti's theorem: each of two loads does the same work on the displacements of the other.
/// Collocation satisfies it only in the limit.
double reciprocityDefect(int cells) {
  const LoadedSphere sphere(cells);
  const VectorXd first = sphere.load(kTop, kPush), second = sphere.load(kSide, kPull);
  const BoundaryField a = sphere.solve(first), b = sphere.solve(second);
  const double ab = sphere.work(first, b.u.col(0)), ba = sphere.work(second, a.u.col(0));
  const double self = std::sqrt(sphere.work(first, a.u.col(0)) * sphere.work(second, b.u.col(0)));
  const double defect = std::abs(ab - ba) / self;
  std::printf("reciprocity: n %d, mutual work %.2e of the own, defect %.1e\n",
              sphere.mesh.nodeCount(), ab / self, defect);
  return defect;
}

TEST(Energy, WorkOfTwoLoadsOnEachOtherIsReciprocal) {
  const double coarse = reciprocityDefect(7), fine = reciprocityDefect(11);
  EXPECT_LE(fine, 0.01);  // design/bem.md: 1 % from 600 nodes on
  EXPECT_LT(fine, coarse);
}

}  // namespace
}  // namespace palpa::bem
