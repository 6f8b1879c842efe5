#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hertz.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/knot_operations.h"
#include "touched_body.h"

namespace palpa::bem::test {
namespace {

/// The patch that contains the top of the sphere.
int topPatch(const modeling::Solid& solid) {
  int best = 0;
  double highest = -INFINITY;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    double sum = 0, count = 0;
    for (const auto& row : solid.patches()[p].net)
      for (const int point : row) {
        sum += solid.controlPoints()[point].z();
        ++count;
      }
    if (sum / count > highest) {
      highest = sum / count;
      best = static_cast<int>(p);
    }
  }
  return best;
}

/// Halves the spans that reach into a part of the parameters' range around its middle, in both
/// directions of a patch.
modeling::Solid refinedAround(modeling::Solid solid, int patch, double part) {
  for (int d = 0; d < 2; ++d) {
    const std::vector<double> knots = solid.patches()[patch].knots[d];
    const double middle = (knots.front() + knots.back()) / 2, size = knots.back() - knots.front();
    for (std::size_t k = 0; k + 1 < knots.size(); ++k)
      if (knots[k] < knots[k + 1] && knots[k] < middle + part / 2 * size - 1e-9 &&
          knots[k + 1] > middle - part / 2 * size + 1e-9)
        solid = modeling::insertKnot(solid, {patch, d}, (knots[k] + knots[k + 1]) / 2);
  }
  return solid;
}

/// Masks are 1.25 mm apart; contacts from 1.8 to 4 times that wide. What is left comes in waves
/// with the number of masks that fit into the circle; with masks half as far apart (n = 2,098) it
/// is 1.5 % at a = 1.2 mm and at most 0.6 % from 1.7 on.
TEST(SplineHertz, ARigidBallOnASphere) {
  modeling::Solid solid = modeling::makeSphere(kHertzRadius, 7);
  const int patch = topPatch(solid);
  for (const double part : {0.5, 0.4, 0.3}) solid = refinedAround(solid, patch, part);
  SplineTouched body(solid, -20, kHertzMaterial, 3, Precision::kAutomatic);
  std::printf("n = %d\n", body.splines.coefficientCount());
  expectHertz(
      {body.surface(), body.columns(), body.base()}, {2.2, 2.7, 3.2, 3.7, 4.2, 5.0},
      [](double a) { return a < 3 ? 0.035 : 0.015; }, 0.01);
}

}  // namespace
}  // namespace palpa::bem::test
