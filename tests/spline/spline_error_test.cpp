#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_results.h"
#include "bem/spline/spline_state.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d kForce(0.03, -0.02, 0.06);

/// Root mean squares over the surface relative to the exact displacement, and largest values
/// relative to the largest error.
struct Effectivity {
  double error = 0, defect = 0, estimate = 0;
  double largestDefect = 0, largestEstimate = 0;
};

Effectivity effectivity(const char* name, const SplineBody& body, const ExactField& exact) {
  const SplineResults results(body.surface, body.tractions);
  const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
  const VectorXd correction =
      estimatedError(
          results, *body.problem, body.field, body.material, [](int) { return 1.0; }, Job{})
          .u.col(0);
  Effectivity sum;
  double scale = 0, largestError = 0;
  visitSplinePoints(
      body.surface, allElements(body.surface), 2, INFINITY,
      [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
        const SplineMesh::Point at{place.element, body.surface.parameters(place).parameters};
        const Vector3d expected = exact.displacement(jet.position);
        const Vector3d error = expected - body.displacement(place);
        const Vector3d defect =
            results.displacementDefect(surfacePlaces(body.surface, at), u, p, body.material);
        const Vector3d estimate =
            defect + splineValue(body.surface, at, body.surface.functions(at.element), correction);
        sum.error += weight * error.squaredNorm();
        sum.defect += weight * defect.squaredNorm();
        sum.estimate += weight * estimate.squaredNorm();
        scale += weight * expected.squaredNorm();
        largestError = std::max(largestError, error.norm());
        sum.largestDefect = std::max(sum.largestDefect, defect.norm());
        sum.largestEstimate = std::max(sum.largestEstimate, estimate.norm());
      });
  for (double* value : {&sum.error, &sum.defect, &sum.estimate}) *value = std::sqrt(*value / scale);
  for (double* value : {&sum.largestDefect, &sum.largestEstimate}) *value /= largestError;
  std::printf(
      "%-14s n %4d  error of u %.1e; over it: defect %.3f (largest %.3f), estimate %.2f (%.2f)\n",
      name, body.surface.coefficientCount(), sum.error, sum.defect / sum.error, sum.largestDefect,
      sum.estimate / sum.error, sum.largestEstimate);
  return sum;
}

/// A body with a Kelvin source outside; every knot span of its solid is halved `halvings` times.
struct Case {
  const char* name;
  modeling::Solid solid;
  int halvings;
  std::function<bool(const Vector3d&)> isFixed;
  Vector3d source;
};

Effectivity effectivity(const Case& each, double nu) {
  const Material material{0.1, nu};
  modeling::Solid fine = each.solid;
  for (int k = 0; k < each.halvings; ++k) fine = halved(fine);
  const ExactField exact = kelvinField(each.source, kForce, material);
  return effectivity(
      each.name,
      SplineBody(fixedWhere(app::splineSurfaceOf(fine), each.isFixed), material, exact, {1e-6}),
      exact);
}

/// The defect alone is 0.3 to 0.8 of the error, also of its largest value.
TEST(SplineErrors, OfCompactBodiesAreEstimatedWithinAFactorOfTwo) {
  const auto base = [](const Vector3d& x) { return x.z() < 1e-6; };
  const auto threeSides = [](const Vector3d& x) {
    return x.z() < 1e-6 || x.x() < -20 + 1e-6 || x.y() < -15 + 1e-6;
  };
  const auto hole = [](const Vector3d& x) { return x.z() < -7; };
  const modeling::Solid box = modeling::makeBox({40, 30, 20});
  const Vector3d aside(20, 15, 40), above(10, 5, 35);
  const Case ball{"sphere", modeling::makeSphere(25, 7), 0, isBelow, aside};
  const Case block{"box", box, 1, base, above};
  for (const auto& [each, nu] : std::vector<std::pair<Case, double>>{
           {ball, 0.3},
           {ball, 0.5},
           {{"sphere", modeling::makeSphere(25, 9), 0, isBelow, aside}, 0.3},
           {block, 0.3},
           {block, 0.5},
           {{"box", box, 2, base, above}, 0.3},
           {{"box, 3 sides", box, 1, threeSides, above}, 0.3},
           {{"torus", makeTorus(30, 10), 0, hole, {3, -2, 6}}, 0.3}}) {
    const Effectivity found = effectivity(each, nu);
    EXPECT_GE(found.estimate / found.error, 0.5) << each.name;
    EXPECT_LE(found.estimate / found.error, 2) << each.name;
    EXPECT_GE(found.largestEstimate, 0.4) << each.name;
    EXPECT_LE(found.largestEstimate, 2) << each.name;
    for (const double ratio : {found.defect / found.error, found.largestDefect}) {
      EXPECT_GE(ratio, 0.25) << each.name;
      EXPECT_LE(ratio, 1) << each.name;
    }
  }
}

/// The residual of bending is smaller than its displacement by the square of the slenderness, so
/// that one more iterate hardly changes it; solving for the residual does.
TEST(SplineErrors, OfSlenderBodiesAreEstimatedWithinAFactorOfFive) {
  const auto end = [](const Vector3d& x) { return x.x() < -50 + 1e-6; };
  const modeling::Solid rod = modeling::makeBox({100, 10, 10}),
                        plate = modeling::makeBox({60, 60, 4});
  const auto edge = [](const Vector3d& x) { return x.x() < -30 + 1e-6; };
  for (const Case& each : {Case{"cylinder",
                                modeling::makeCylinder(20, 60),
                                0,
                                [](const Vector3d& x) { return x.z() < 1e-6; },
                                {35, 10, 40}},
                           {"rod, at tip", rod, 1, end, {40, 3, 25}},
                           {"rod, at tip", rod, 2, end, {40, 3, 25}},
                           {"rod, at root", rod, 1, end, {-45, 3, 25}},
                           {"rod, at root", rod, 2, end, {-45, 3, 25}},
                           {"plate", plate, 1, edge, {20, 3, 15}},
                           {"plate", plate, 2, edge, {20, 3, 15}}}) {
    const Effectivity found = effectivity(each, 0.3);
    EXPECT_GE(found.estimate / found.error, 0.2) << each.name;
    EXPECT_LE(found.estimate / found.error, 5) << each.name;
  }
}

}  // namespace
}  // namespace palpa::bem::test
