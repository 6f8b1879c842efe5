#include <gtest/gtest.h>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/dense/make_reference_problem.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

struct Difference {
  double displacement, traction;
};

/// Largest difference from the solution in double precision, over the largest value.
Difference differenceTo(const verification::SolvedBody& expected,
                        const verification::SolvedBody& found) {
  return {(found.field.u - expected.field.u).lpNorm<Eigen::Infinity>() /
              expected.field.u.lpNorm<Eigen::Infinity>(),
          (found.field.p - expected.field.p).lpNorm<Eigen::Infinity>() /
              expected.field.p.lpNorm<Eigen::Infinity>()};
}

TEST(Precision, SinglePrecisionErrorIsSmallAgainstTheDiscretisation) {
  for (const double nu : {0.3, 0.49, 0.5}) {
    const Material material{0.1, nu};
    const auto exact = verification::kelvinField({8, -5, 38}, {0.03, -0.02, 0.06}, material);
    const auto solve = [&](Precision precision) {
      return verification::SolvedBody(
          verification::retagged(verification::sphereMesh(25, 9), 1,
                                 [](const Vector3d& x) { return x[2] < -10; }),
          material, exact,
          [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; },
          {precision, {}});
    };
    const auto full = solve(Precision::kDouble);
    const Difference mixed = differenceTo(full, solve(Precision::kMixed));
    const Difference single = differenceTo(full, solve(Precision::kSingle));
    std::printf("nu %.2f: mixed u %.1e p %.1e, single u %.1e p %.1e; discretisation u %.1e\n", nu,
                mixed.displacement, mixed.traction, single.displacement, single.traction,
                full.maxDisplacementError(exact));
    // Refined with residuals in double precision: rounding times the condition (about 1e3).
    EXPECT_LE(mixed.displacement, 1e-12);
    EXPECT_LE(mixed.traction, 1e-12);
    // Entries rounded to 6e-8, with errors that mostly cancel in sums; measured 4e-8 and 1e-7.
    EXPECT_LE(single.displacement, 1e-6);
    EXPECT_LE(single.traction, 3e-6);
    EXPECT_LE(single.displacement, 1e-3 * full.maxDisplacementError(exact));
  }
}

TEST(Precision, MemoryEstimateEqualsTheMemoryUsed) {
  for (const Precision precision : {Precision::kDouble, Precision::kMixed, Precision::kSingle}) {
    const Material material{0.1, 0.3};
    const verification::SolvedBody body(
        verification::boxMesh({0, 0, 0}, {4, 3, 2}, 4, 3, 2), material,
        verification::linearField(verification::generalGradient(false), {0, 0, 0}, material),
        [](int tag) { return tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction; },
        {precision, {}});
    const double estimate = estimateBytes(body.mesh.nodeCount(), body.slots.count(), precision);
    // The estimate does not include the pivots.
    EXPECT_NEAR(static_cast<double>(body.problem->bytes()), estimate, 0.02 * estimate);
  }
}

}  // namespace
}  // namespace palpa::bem
