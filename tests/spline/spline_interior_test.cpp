#include "bem/element/element_interior.h"

#include "app/verification/exact/textbook_fields.h"
#include "bem/spline/spline_results.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Points below every seventh element, under the middle and near an edge, at parts of its size.
std::vector<Vector3d> pointsBelow(const SplineSurface& surface, double depth) {
  std::vector<Vector3d> points;
  for (int e = 0; e < surface.elementCount(); e += 7) {
    const SplineElement& element = surface.elements()[e];
    const double width = element.upper[0] - element.lower[0];
    const ElementPlace place{e, element.lower[0] + (e % 2 ? 0.5 : 0.97) * width,
                             (element.lower[1] + element.upper[1]) / 2};
    const SurfaceJet jet = surface.evaluate(place);
    points.push_back(jet.position - depth * jet.du.norm() * width * surface.normal(place));
  }
  return points;
}

TEST(ElementInterior, FollowsAPointForceUpToTheSurface) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = kelvinField({20, 15, 40}, {0.03, -0.02, 0.06}, material);
    const SplineBody body(fixedWhere(app::splineSurfaceOf(modeling::makeSphere(25, 9)), isBelow),
                          material, exact, {1e-6});
    const SplineQuadrature quadrature(body.surface, ElementInterior::kTolerance);
    const SplineElements elements(body.surface, body.tractions);
    const SplineResults fine(body.surface, body.tractions);
    const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
    for (const auto& [depth, displacement, stress] : {std::tuple(2.0, 5e-4, 1e-3),
                                                      {0.5, 1e-3, 8e-3},
                                                      {0.1, 1e-3, 1.2e-2},
                                                      {1e-2, 1e-3, 1.2e-2},
                                                      {1e-4, 1e-3, 1.2e-2},
                                                      {0.0, 1e-3, 1.2e-2}}) {
      const std::vector<Vector3d> points = pointsBelow(body.surface, depth);
      const ElementInterior interior(elements, quadrature, material, points, {});
      const std::vector<InteriorState> states = interior.evaluate(u, p, {});
      double largestU = 0, largestStress = 0, errorU = 0, errorStress = 0, beside = 0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Matrix3d truth = exact.stress(points[k]);
        const Vector3d moved = exact.displacement(points[k]);
        largestStress = std::max(largestStress, truth.norm());
        largestU = std::max(largestU, moved.norm());
        errorU = std::max(errorU, (states[k].displacement - moved).norm());
        errorStress = std::max(errorStress, (states[k].stress - truth).norm());
        const auto reference = fine.interiorState(u, p, material, points[k]);
        ASSERT_TRUE(reference);
        beside = std::max(beside, (states[k].stress - reference->stress).norm());
      }
      std::printf("nu %.1f, depth %g: u %.1e, stress %.1e, beside tolerance 1e-6 %.1e\n", nu, depth,
                  errorU / largestU, errorStress / largestStress, beside / largestStress);
      EXPECT_LE(errorU, displacement * largestU);
      EXPECT_LE(errorStress, stress * largestStress);
      EXPECT_LE(beside, 3e-4 * largestStress);
    }
  }
}

TEST(ElementInterior, KeepsALinearFieldExactlyHoweverNearTheSurface) {
  const Material material{0.1, 0.3};
  const ExactField exact = linearField(generalGradient(false), {0.1, -0.2, 0.3}, material);
  const SplineSurface surface = app::splineSurfaceOf(modeling::makeBox({40, 30, 20}));
  const SplineTractions tractions(surface);
  VectorXd u(3 * surface.coefficientCount());
  for (int k = 0; k < surface.coefficientCount(); ++k)
    u.segment<3>(3 * k) = exact.displacement(surface.controlPoints()[k]);
  const VectorXd p = projectTraction(
      surface, tractions, allElements(surface),
      [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
      INFINITY);
  const SplineQuadrature quadrature(surface, ElementInterior::kTolerance);
  const std::vector<Vector3d> points{{1, 2, 11}, {3, 4, 20 - 1e-3},          {3, 4, 1e-7},
                                     {0, 0, 0},  {20 - 1e-4, 15 - 1e-4, 10}, {-19.99, -14.9, 0.02}};
  const SplineElements elements(surface, tractions);
  const ElementInterior interior(elements, quadrature, material, points, {});
  const auto states = interior.evaluate(u, p, {});
  const Matrix3d stress = exact.stress(Vector3d::Zero());
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_LE((states[k].displacement - exact.displacement(points[k])).norm(), 1e-9);
    EXPECT_LE((states[k].stress - stress).norm(), 1e-8 * stress.norm());
  }
}

/// A body in the wall of a pressurised thick sphere, beside the cavity.
TEST(SplineInterior, FollowsLamesFieldOfAThickSphere) {
  const Material material{0.1, 0.45};
  const Vector3d centre(0, 10, 50);
  const ExactField exact = verification::pressurisedSphereField(12, 70, 0.01, material, centre);
  const SplineBody body(fixedWhere(app::splineSurfaceOf(modeling::makeSphere(25, 9)), isBelow),
                        material, exact, {1e-6});
  const SplineQuadrature quadrature(body.surface, ElementInterior::kTolerance);
  const std::vector<Vector3d> points{{0, 0, 0},   {0, 3, 24},    {10, 5, 15}, {-12, -8, 10},
                                     {20, 0, -5}, {5, -20, -10}, {0, 0, -24}, {0.1, 0.2, 24.9}};
  const SplineElements elements(body.surface, body.tractions);
  const ElementInterior interior(elements, quadrature, material, points, {});
  const auto states = interior.evaluate(body.field.u.col(0), body.field.p.col(0), {});
  double largestU = 0, largestStress = 0, errorU = 0, errorStress = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Matrix3d stress = exact.stress(points[k]);
    largestU = std::max(largestU, exact.displacement(points[k]).norm());
    largestStress = std::max(largestStress, stress.norm());
    errorU = std::max(errorU, (states[k].displacement - exact.displacement(points[k])).norm());
    errorStress = std::max(errorStress, (states[k].stress - stress).norm());
  }
  std::printf("thick sphere: u %.1e, stress %.1e\n", errorU / largestU,
              errorStress / largestStress);
  EXPECT_LE(errorU, 2e-3 * largestU);
  EXPECT_LE(errorStress, 2e-2 * largestStress);
}

}  // namespace
}  // namespace palpa::bem::test
