#include "bem/spline/spline_body_force.h"

#include "bem/element/element_body_force.h"
#include "bem/element/element_interior.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_integrals.h"
#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_results.h"
#include "bem/spline/surface_part.h"
#include "bem/triangle/triangle_body_force.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d kForce(3e-5, -7e-5, 5e-5);  // N/mm^3, oblique
const Vector3d kEnd(4, -9, -6);

SplineSurface boxFixedBelow(int parts = 1) {
  return fixedWhere(app::splineSurfaceOf(divided(modeling::makeBox({40, 30, 20}), parts)),
                    [](const Vector3d& x) { return x.z() < 1e-9; });
}

/// Quadratic fields are splines of a box, and their tractions too: the error is left of the
/// integrals.
TEST(SplineBodyForce, ObliqueWeightOfABoxIsExact) {
  for (const double nu : {-0.4, 0.0, 0.3, 0.49, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = hangingBarField(kForce, kEnd, material);
    const SplineBody body(boxFixedBelow(), material, exact, {1e-7});
    const double error = body.displacementError(exact), ofTraction = body.tractionError(exact);
    std::printf("weight of a spline box, nu %4.2f: u %.1e, p %.1e\n", nu, error, ofTraction);
    EXPECT_LE(error, 1e-6) << "nu = " << nu;
    EXPECT_LE(ofTraction, 2e-5) << "nu = " << nu;
  }
}

TEST(SplineBodyForce, CutSupportsAreExactToo) {
  // The support ends in the middle of the side faces: Galerkin's equations for the cut functions.
  const Material material{0.1, 0.3};
  const ExactField exact = hangingBarField(kForce, kEnd, material);
  const SplineSurface cut = withPart(
      app::splineSurfaceOf(divided(modeling::makeBox({40, 30, 20}), 2)),
      [](const Vector3d& x) { return Vector3d(0.1, 0.05, 1).normalized().dot(x) - 7; }, 1);
  ASSERT_FALSE(splineEquations(cut, SplineTractions(cut), {}).isCollocation());
  const SplineBody body(cut, material, exact, {1e-7});
  const double error = body.displacementError(exact);
  std::printf("weight of a spline box on a cut support: u %.1e\n", error);
  EXPECT_LE(error, 1e-5);
}

TEST(SplineBodyForce, SphereAndTorusAreAsAccurateAsTheBestApproximation) {
  const auto lowestOfTorus = [](const Vector3d& x) { return x.z() < -7; };
  for (const auto& [solid, isFixed] :
       {std::pair<modeling::Solid, std::function<bool(const Vector3d&)>>(
            halved(modeling::makeSphere(25)), isBelow),
        {halved(makeTorus(30, 10)), lowestOfTorus}})
    for (const double nu : {0.3, 0.5}) {
      const Material material{0.1, nu};
      const ExactField exact = hangingBarField(kForce, kEnd, material);
      const SplineBody body(fixedWhere(app::splineSurfaceOf(solid), isFixed), material, exact);
      const double error = body.displacementError(exact),
                   least = body.leastDisplacementError(exact);
      std::printf("weight, n %d, nu %.1f: u %.1e, best %.1e\n", body.surface.coefficientCount(), nu,
                  error, least);
      EXPECT_LE(error, 3 * least) << "of which 2 were measured";
    }
}

TEST(SplineBodyForce, TermEqualsThatOfFineTriangles) {
  const Material material{0.1, 0.3};
  const Bulk bulk{material, kForce};
  const auto on = discretised(modeling::makeSphere(25), 1.2, [](const Vector3d&) { return 0; });
  const SplineQuadrature quadrature(on->surface(), 1e-6);
  const ElementBodyForce splines(on->elements(), quadrature, bulk);
  const TriangleBodyForce triangles(on->mesh());
  const auto workspace = quadrature.makeWorkspace();
  ElementQuadrature::Workspace& work = *workspace;
  for (const CollocationPlace& point : grevilleCollocation(on->surface())) {
    const Vector3d expected = triangles.at(point.position, bulk);
    // The polyhedron lacks about (h / R)^2 / 5 of the volume.
    EXPECT_LE((splines.at(point, work) - expected).norm(), 2e-3 * expected.norm());
  }
  const VolumeMoments moments = on->volumeMoments();
  const double volume = 4 / 3.0 * M_PI * 25 * 25 * 25;
  EXPECT_NEAR(moments.volume(), volume, 2e-4 * volume) << "the solid approximates a sphere";
  EXPECT_LE(moments.centroid().norm(), 1e-9);
}

TEST(SplineBodyForce, ResidualEnergyAndInnerStateAreExactOnABox) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const Bulk bulk{material, kForce};
    const ExactField exact = hangingBarField(kForce, kEnd, material);
    const SplineBody body(boxFixedBelow(), material, exact, {1e-7});
    const SplineResults results(body.surface, body.tractions);
    const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
    const double largest = u.lpNorm<Eigen::Infinity>();
    for (int e = 0; e < body.surface.elementCount(); e += 5) {
      const CollocationPlace at = surfacePlaces(body.surface, {e, {0.37, 0.61}});
      const Vector3d defect = results.displacementDefect(at, u, p, bulk),
                     without = results.displacementDefect(at, u, p, material);
      EXPECT_LE(defect.norm(), 1e-5 * largest);
      EXPECT_GE(without.norm(), 1e-2 * largest) << "the residual contains the weight";
    }
    const VectorXd estimate =
        estimatedError(
            results, *body.problem, body.field, bulk, [](int) { return 1.0; }, Job{})
            .u.col(0);
    EXPECT_LE(estimate.lpNorm<Eigen::Infinity>(), 1e-5 * largest);
    const std::vector<Vector3d> points{{0, 0, 10}, {-12, 9, 15}, {15, -10, 0.1}};
    const SplineQuadrature quadrature(body.surface, ElementInterior::kTolerance, {});
    const std::vector<InteriorState> states =
        ElementInterior(SplineElements(body.surface, body.tractions), quadrature, bulk, points, {})
            .evaluate(u, p, {});
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector3d& x = points[k];
      EXPECT_LE((states[k].displacement - exact.displacement(x)).norm(), 1e-4 * largest);
      EXPECT_LE((states[k].stress - exact.stress(x)).norm(), 1e-2 * kForce.norm() * 20);
      const auto state = results.interiorState(u, p, bulk, x);
      ASSERT_TRUE(state);
      EXPECT_LE((state->displacement - exact.displacement(x)).norm(), 1e-5 * largest);
      EXPECT_LE((state->stress - exact.stress(x)).norm(), 1e-3 * kForce.norm() * 20);
    }
    const VolumeMoments moments = volumeMoments(body.surface);
    const double middle = kForce.dot(moments.centroid() - kEnd);
    const double expected =
        (kForce.dot(moments.secondMoments() * kForce) + moments.volume() * middle * middle) /
        (2 * material.youngsModulus);
    const double energy = SplineIntegrals(body.surface, body.tractions).strainEnergy(u, p) +
                          bodyForceWork(body.surface, body.tractions, bulk).value(u, p) / 2;
    EXPECT_NEAR(energy, expected, 1e-5 * expected);
  }
}

}  // namespace
}  // namespace palpa::bem::test
