#include "app/verification/exact/solved_body.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

struct Step {
  int coefficients;
  double error, order;
};

std::vector<Step> converge(const char* name, const std::vector<SplineSurface>& surfaces,
                           const ExactField& exact, const Material& material) {
  std::vector<Step> steps;
  for (const SplineSurface& surface : surfaces) {
    const SplineBody body(surface, material, exact, {1e-5});
    Step step{surface.coefficientCount(), body.displacementError(exact), 0};
    if (!steps.empty())
      step.order = observedOrder(steps.back().error, steps.back().coefficients, step.error,
                                 step.coefficients);
    std::printf("%-14s n %5d (+%zu)  error of u %.2e, of p %.2e  order of u %.2f  %.3f + %.3f s\n",
                name, step.coefficients, body.problem->dofs().extraSlots().size(), step.error,
                body.tractionError(exact), step.order, body.times.assemble, body.times.factorise);
    steps.push_back(step);
  }
  return steps;
}

/// The sphere is in app/verification.
TEST(SplineConvergence, OtherBodies) {
  const Material material{0.1, 0.3};
  const auto series = [&](const char* name, const modeling::Solid& solid, int refinements,
                          const auto& fixed, const ExactField& exact) {
    std::vector<SplineSurface> surfaces;
    modeling::Solid fine = solid;
    for (int k = 0;; ++k) {
      surfaces.push_back(fixedWhere(app::splineSurfaceOf(fine), fixed));
      if (k == refinements) break;
      fine = halved(fine);
    }
    return converge(name, surfaces, exact, material);
  };
  const auto base = [](const Vector3d& x) { return x.z() < 1e-6; };
  const auto ends = [](const Vector3d& x) { return x.z() < 1e-6 || x.z() > 60 - 1e-6; };
  const ExactField aside = kelvinField({35, 10, 40}, {0.03, 0.02, -0.05}, material);
  const auto cylinder = modeling::makeCylinder(20, 60);
  const auto expectLast = [](const std::vector<Step>& steps, double error, double order) {
    EXPECT_LE(steps.back().error, error);
    EXPECT_GE(steps.back().order, order);
  };
  // The nets of cylinder and box are too coarse at first to see the source: 3 element lengths off.
  expectLast(series("cylinder", cylinder, 2, base, aside), 1.5e-3, 3.5);
  expectLast(series("fixed cylinder", cylinder, 2, ends, aside), 1.2e-3, 3);
  const ExactField above = kelvinField({10, 5, 35}, {0.03, -0.02, 0.06}, material);
  const auto box = modeling::makeBox({40, 30, 20});
  expectLast(series("box", box, 3, base, above), 5e-4, 4);
  // Two fixed faces meet in a sharp edge, three in a corner.
  const auto corner = [](const Vector3d& x) {
    return x.z() < 1e-6 || x.x() < -20 + 1e-6 || x.y() < -15 + 1e-6;
  };
  expectLast(series("box, 3 sides", box, 3, corner, above), 5e-4, 4);
  expectLast(series(
                 "torus", makeTorus(30, 10), 0, [](const Vector3d& x) { return x.z() < -7; },
                 kelvinField({3, -2, 6}, {0.04, 0.03, 0.05}, material)),
             5e-4, 0);
}

}  // namespace
}  // namespace palpa::bem::test
