// The finite element solutions of fem.json with splines that are graded towards the clamped
// rim.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "spline_fem.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

const std::vector<double> kTowardsRims{0.04, 0.125, 0.375, 0.625, 0.875, 0.96};

FemErrors solve(const json& reference, const SplineSurface& surface,
                const std::function<Vector3d(const Vector3d&)>& given, const SplineFunction& load,
                double loadRadius) {
  const FemSolution solution = solveFem(reference, surface, given, load, loadRadius);
  const FemErrors& errors = solution.errors;
  std::printf("%s n %d: at load %.2e anywhere %.2e reaction %.2e energy %.2e (%.2f + %.2f s)\n",
              reference["id"].get<std::string>().c_str(), solution.coefficients, errors.atLoad,
              errors.anywhere, errors.reaction, errors.energy, solution.times.assemble,
              solution.times.factorise);
  EXPECT_LE(solution.coefficients, 1200);
  return errors;
}

Vector3d still(const Vector3d&) {
  return Vector3d::Zero();
}

TEST(SplineFem, CylinderPushedAtItsSide) {
  const json reference = femCase("a_cyl_side");
  const SplineSurface surface = fixedCylinder(
      cylinderWithKnots({0.7, 2.5, 6, 11, 17, 22, 26, 30, 34, 38, 43, 51}, kTowardsRims), false);
  const FemErrors errors =
      solve(reference, surface, still, bumpOf(reference), reference["load"]["a"]);
  EXPECT_LE(errors.atLoad, 5e-3);
  EXPECT_LE(errors.anywhere, 5e-3);
  EXPECT_LE(errors.reaction, 3e-3);
  EXPECT_LE(errors.energy, 1e-2);
}

TEST(SplineFem, SphereHeldInAHalfSpaceThatCutsItsPatches) {
  const json reference = femCase("c_sph_pole");
  // Finer at the load and, in the bands around the bottom, where the border of the support runs.
  const SplineSurface surface = fixedSphere(9, {0.04, 0.08, 0.12, 0.42, 0.58, 0.88, 0.92, 0.96});
  const FemErrors errors =
      solve(reference, surface, still, bumpOf(reference), reference["load"]["a"]);
  EXPECT_LE(errors.atLoad, 6e-3);
  EXPECT_LE(errors.anywhere, 1e-2);
  EXPECT_LE(errors.reaction, 3e-3);
  EXPECT_LE(errors.energy, 1e-2);
}

TEST(SplineFem, CylinderPressedBetweenBondedPlates) {
  for (const char* id : {"b_cyl_push_nu0.30", "b_cyl_push_nu0.45"}) {
    const json reference = femCase(id);
    const SplineSurface surface = fixedCylinder(
        cylinderWithKnots({0.7, 2.5, 6, 12, 20, 30, 40, 48, 54, 57.5, 59.3}, kTowardsRims), true);
    const Vector3d top = vectorOf(reference["top"]);
    const FemErrors errors = solve(
        reference, surface,
        [&](const Vector3d& x) { return Vector3d(x.z() > 30 ? top : Vector3d::Zero()); }, {},
        INFINITY);
    EXPECT_LE(errors.anywhere, 5e-3);
    EXPECT_LE(errors.reaction, 3e-3);
    EXPECT_LE(errors.energy, 1e-2);
  }
}

}  // namespace
}  // namespace palpa::bem::test
