#include "bem/spline/spline_results.h"

#include <numeric>

#include "app/verification/exact/textbook_fields.h"
#include "bem/spline/spline_integrals.h"
#include "bem/spline/spline_state.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d kForce(0.03, -0.02, 0.06);

/// A linear field: its displacements are splines, its tractions are projected.
struct LinearBody {
  Material material{0.1, 0.3};
  Matrix3d gradient = generalGradient(false);
  ExactField exact = linearField(gradient, {0.1, -0.2, 0.3}, material);
  SplineSurface surface;
  SplineTractions tractions;
  VectorXd u, p;

  explicit LinearBody(const modeling::Solid& solid)
      : surface(app::splineSurfaceOf(solid)),
        tractions(surface),
        u(3 * surface.coefficientCount()),
        p(projectTraction(
            surface, tractions, allElements(surface),
            [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
            INFINITY)) {
    for (int k = 0; k < surface.coefficientCount(); ++k)
      u.segment<3>(3 * k) = exact.displacement(surface.controlPoints()[k]);
  }
};

TEST(SplineIntegrals, LinearFieldsAreBalancedAndHaveTheEnergyOfTheirStress) {
  for (const modeling::Solid& solid :
       {modeling::makeBox({40, 30, 20}), modeling::makeSphere(25, 7), makeTorus(30, 10)}) {
    const LinearBody body(solid);
    const SplineIntegrals integrals(body.surface, body.tractions);
    double volume = 0, area = 0;
    const std::vector<int> all = allElements(body.surface);
    visitSplinePoints(body.surface, all, 8, INFINITY,
                      [&](const ElementPlace&, const SurfaceJet& jet, double weight) {
                        volume += weight * jet.position.dot(jet.areaVector().normalized()) / 3;
                        area += weight;
                      });
    const Matrix3d stress = body.exact.stress(Vector3d::Zero());
    const Matrix3d strain = (body.gradient + body.gradient.transpose()) / 2;
    const double energy = 0.5 * stress.cwiseProduct(strain).sum() * volume;
    // What is left is the quadrature of the projection, in which roots of polynomials appear.
    EXPECT_NEAR(integrals.strainEnergy(body.u, body.p), energy, 1e-6 * energy);
    const Resultant sum = integrals.resultant(body.p, all);
    EXPECT_LE(sum.force.norm(), 1e-7 * stress.norm() * area);
    EXPECT_LE(sum.moment.norm(), 1e-7 * stress.norm() * area * 30);
    double ofFunctions = 0;
    for (int k = 0; k < body.surface.coefficientCount(); ++k) ofFunctions += integrals.area(k);
    EXPECT_NEAR(ofFunctions, area, 1e-7 * area);
    // A rigid motion does no work.
    VectorXd rigid(body.u.size());
    for (int k = 0; k < body.surface.coefficientCount(); ++k)
      rigid.segment<3>(3 * k) = Vector3d(0.1, 0.2, -0.3) +
                                Vector3d(0.01, -0.02, 0.03).cross(body.surface.controlPoints()[k]);
    EXPECT_NEAR(integrals.strainEnergy(rigid, body.p), 0, 1e-6 * energy);
  }
}

TEST(SplineIntegrals, AFaceCarriesStressTimesArea) {
  const LinearBody body(modeling::makeBox({40, 30, 20}));
  const SplineIntegrals integrals(body.surface, body.tractions);
  const SplineSurface tagged =
      fixedWhere(body.surface, [](const Vector3d& x) { return x.z() > 20 - 1e-9; });
  std::vector<int> top;
  for (const int e : allElements(tagged))
    if (tagged.elements()[e].tag == 1) top.push_back(e);
  const Vector3d force = body.exact.stress(Vector3d::Zero()) * Vector3d(0, 0, 40 * 30);
  const Resultant sum = integrals.resultant(body.p, top);
  EXPECT_LE((sum.force - force).norm(), 1e-10 * force.norm());
  EXPECT_LE((sum.moment - Vector3d(0, 0, 20).cross(force)).norm(), 1e-9 * 20 * force.norm());
}

TEST(SplineElements, StateIsThatOfALinearField) {
  // On bent faces the projected tractions err, which the stress takes over.
  for (const auto& [solid, tolerance] : {std::pair(modeling::makeBox({40, 30, 20}), 1e-9),
                                         {modeling::makeSphere(25, 9), 3e-3},
                                         {makeTorus(30, 10), 2e-3}}) {
    const LinearBody body(solid);
    const Matrix3d stress = body.exact.stress(Vector3d::Zero());
    double worst = 0;
    for (int e = 0; e < body.surface.elementCount(); ++e)
      for (const double s : {0.0, 0.3, 1.0}) {
        const SplineElement& element = body.surface.elements()[e];
        const SurfaceState state =
            SplineElements(body.surface, body.tractions)
                .state({e, element.lower[0] + s * (element.upper[0] - element.lower[0]),
                        element.lower[1] + 0.7 * s * (element.upper[1] - element.lower[1])},
                       body.u, body.p, body.material);
        worst = std::max(worst, (state.stress - stress).norm() / stress.norm());
        EXPECT_LE((state.gradient - body.gradient).norm(), 10 * tolerance * body.gradient.norm());
        EXPECT_LE((state.displacement - body.exact.displacement(state.position)).norm(), 1e-9);
      }
    std::printf("stress of a linear field: largest relative error %.1e\n", worst);
    EXPECT_LE(worst, tolerance);
  }
}

/// Points below the surface: at parts of the size of their element, under the middle and near an
/// edge of every seventh element.
struct InteriorError {
  double displacement = 0, stress = 0;
};
InteriorError interiorError(const SplineBody& body, const ExactField& exact, double depth) {
  const SplineResults results(body.surface, body.tractions);
  const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
  InteriorError worst;
  double largestStress = 0;
  for (int e = 0; e < body.surface.elementCount(); e += 7) {
    const SplineElement& element = body.surface.elements()[e];
    const double width = element.upper[0] - element.lower[0];
    const ElementPlace place{e, element.lower[0] + (e % 2 ? 0.5 : 0.97) * width,
                             (element.lower[1] + element.upper[1]) / 2};
    const SurfaceJet jet = body.surface.evaluate(place);
    const Vector3d x = jet.position - depth * jet.du.norm() * width * body.surface.normal(place);
    const auto state = results.interiorState(u, p, body.material, x);
    EXPECT_TRUE(state);
    if (!state) continue;
    const Matrix3d stress = exact.stress(x);
    largestStress = std::max(largestStress, stress.norm());
    worst.displacement =
        std::max(worst.displacement, (state->displacement - exact.displacement(x)).norm() /
                                         exact.displacement(x).norm());
    worst.stress = std::max(worst.stress, (state->stress - stress).norm());
    EXPECT_FALSE(results.interiorState(u, p, body.material, 2 * jet.position - x));
  }
  worst.stress /= largestStress;
  return worst;
}

TEST(SplineInteriorState, IsThatOfAPointForceUpToTheSurface) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = kelvinField({20, 15, 40}, kForce, material);
    const SplineBody body(fixedWhere(app::splineSurfaceOf(modeling::makeSphere(25, 9)), isBelow),
                          material, exact, {1e-6});
    // Errors are smaller farther inside; at the surface only the error of the tractions remains.
    for (const auto& [depth, displacement, stress] : {std::tuple(2.0, 5e-4, 1e-3),
                                                      {0.5, 1e-3, 8e-3},
                                                      {0.1, 1e-3, 1.2e-2},
                                                      {1e-4, 1e-3, 1.2e-2}}) {
      const InteriorError error = interiorError(body, exact, depth);
      std::printf("nu %.1f, %g elements below the surface: u %.1e, stress %.1e\n", nu, depth,
                  error.displacement, error.stress);
      EXPECT_LE(error.displacement, displacement);
      EXPECT_LE(error.stress, stress);
    }
  }
}

TEST(SplineInteriorState, OfALinearFieldIsExactHoweverNearTheSurface) {
  const LinearBody body(modeling::makeBox({40, 30, 20}));
  const SplineResults results(body.surface, body.tractions);
  const Matrix3d stress = body.exact.stress(Vector3d::Zero());
  for (const Vector3d& x : {Vector3d(1, 2, 11), Vector3d(3, 4, 20 - 1e-3), Vector3d(3, 4, 1e-7),
                            Vector3d(20 - 1e-4, 15 - 1e-4, 10), Vector3d(-19.99, -14.9, 0.02)}) {
    const auto state = results.interiorState(body.u, body.p, body.material, x);
    ASSERT_TRUE(state);
    EXPECT_LE((state->displacement - body.exact.displacement(x)).norm(), 1e-9);
    EXPECT_LE((state->stress - stress).norm(), 1e-8 * stress.norm());
  }
}

/// With no linear field to take away but a quadratic one: pure bending, which cubics carry exactly.
TEST(SplineInteriorState, OfBendingKeepsTheToleranceOfTheQuadrature) {
  const Material material{0.1, 0.3};
  const double curvature = 0.01;
  const ExactField exact = verification::bendingField(curvature, material);
  SplineSurface surface = app::splineSurfaceOf(modeling::makeBox({40, 30, 20}));
  const SplineTractions tractions(surface);
  const auto all = allElements(surface);
  const VectorXd u = projectDisplacement(
                     surface,
                     [&](const Vector3d&x, const Vector3d&) { return exact.displacement(x); }),
                 p = projectTraction(
                     surface, tractions, all,
                     [&](const Vector3d&x, const Vector3d&n) {
                       return Vector3d(exact.stress(x) * n);
                     },
                     INFINITY);
  const SplineResults results(surface, tractions);
  const double largest = material.youngsModulus * curvature * 20;
  for (const Vector3d& x : {Vector3d(1, 2, 11), Vector3d(3, 4, 19.9), Vector3d(3, 4, 1e-3),
                            Vector3d(19.99, 14.99, 10), Vector3d(-19.99, -14.9, 0.02)}) {
    const auto state = results.interiorState(u, p, material, x);
    ASSERT_TRUE(state);
    EXPECT_LE((state->displacement - exact.displacement(x)).norm(), 1e-5);
    EXPECT_LE((state->stress - exact.stress(x)).norm(), 1e-5 * largest);
  }
}

}  // namespace
}  // namespace palpa::bem::test
