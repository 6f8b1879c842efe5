#include "bem/spline/spline_results.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

#include "app/core/spline_surface_of.h"
#include "bem/spline/spline_assembly.h"
#include "bem/spline/spline_integrals.h"
#include "bem/spline/spline_state.h"
#include "bem/spline/surface_part.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/primitives.h"
#include "spline_body.h"
#include "written_out.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d kForce(0.03, -0.02, 0.06);

modeling::Solid torus() {
  modeling::Primitive primitive;
  primitive.shape = modeling::TorusShape{30, 10};
  return modeling::makePrimitive(primitive);
}

std::vector<int> elementsWhere(const SplineSurface& surface,
                               const std::function<bool(const Vector3d&)>& wanted) {
  std::vector<int> list;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplineElement& element = surface.elements()[e];
    if (wanted(surface
                   .evaluate({e, (element.lower[0] + element.upper[0]) / 2,
                              (element.lower[1] + element.upper[1]) / 2})
                   .position))
      list.push_back(e);
  }
  return list;
}

bool anywhere(const Vector3d&) {
  return true;
}
bool isBelow(const Vector3d& x) {
  return x.z() < -std::max(std::abs(x.x()), std::abs(x.y()));
}

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
            surface, tractions, elementsWhere(surface, anywhere),
            [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
            INFINITY)) {
    for (int k = 0; k < surface.coefficientCount(); ++k)
      u.segment<3>(3 * k) = exact.displacement(surface.controlPoints()[k]);
  }
};

TEST(SplineIntegrals, LinearFieldsAreBalancedAndHaveTheEnergyOfTheirStress) {
  for (const modeling::Solid& solid :
       {modeling::makeBox({40, 30, 20}), modeling::makeSphere(25, 7), torus()}) {
    const LinearBody body(solid);
    const SplineIntegrals integrals(body.surface, body.tractions);
    double volume = 0, area = 0;
    const std::vector<int> all = elementsWhere(body.surface, anywhere);
    visitSplinePoints(body.surface, all, 8, INFINITY,
                      [&](const SplinePlace&, const SplineJet& jet, double weight) {
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
  const auto top = elementsWhere(body.surface, [](const Vector3d& x) { return x.z() > 20 - 1e-9; });
  const Vector3d force = body.exact.stress(Vector3d::Zero()) * Vector3d(0, 0, 40 * 30);
  const Resultant sum = integrals.resultant(body.p, top);
  EXPECT_LE((sum.force - force).norm(), 1e-10 * force.norm());
  EXPECT_LE((sum.moment - Vector3d(0, 0, 20).cross(force)).norm(), 1e-9 * 20 * force.norm());
}

TEST(SplineSurfaceState, IsThatOfALinearField) {
  // On bent faces the projected tractions err, which the stress takes over.
  for (const auto& [solid, tolerance] : {std::pair(modeling::makeBox({40, 30, 20}), 1e-9),
                                         {modeling::makeSphere(25, 9), 2e-3},
                                         {torus(), 2e-3}}) {
    const LinearBody body(solid);
    const Matrix3d stress = body.exact.stress(Vector3d::Zero());
    double worst = 0;
    for (int e = 0; e < body.surface.elementCount(); ++e)
      for (const double s : {0.0, 0.3, 1.0}) {
        const SplineElement& element = body.surface.elements()[e];
        const SplineSurfaceState state = splineSurfaceState(
            body.surface, body.tractions,
            {e,
             {element.lower[0] + s * (element.upper[0] - element.lower[0]),
              element.lower[1] + 0.7 * s * (element.upper[1] - element.lower[1])}},
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
    const SplinePlace place{e, element.lower[0] + (e % 2 ? 0.5 : 0.97) * width,
                            (element.lower[1] + element.upper[1]) / 2};
    const SplineJet jet = body.surface.evaluate(place);
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
    const SplineBody body(heldWhere(app::splineSurfaceOf(modeling::makeSphere(25, 9)), isBelow),
                          material, exact, {1e-6});
    for (const double depth : {2.0, 0.5, 0.1, 0.01, 1e-4}) {
      const InteriorError error = interiorError(body, exact, depth);
      std::printf("nu %.1f, %g elements below the surface: u %.1e, stress %.1e\n", nu, depth,
                  error.displacement, error.stress);
    }
  }
}

/// Defect and true error at points all over the surface.
struct Estimate {
  double defect = 0, error = 0, iterate = 0;              // root mean squares
  double largestDefect = 0, largestError = 0, scale = 0;  // mm
};
[[maybe_unused]] Estimate estimate(const SplineBody& body, const ExactField& exact) {
  const SplineResults results(body.surface, body.tractions);
  const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
  Estimate sum;
  visitSplinePoints(
      body.surface, elementsWhere(body.surface, anywhere), 2, INFINITY,
      [&](const SplinePlace& place, const SplineJet& jet, double weight) {
        const Vector3d error = exact.displacement(jet.position) - body.displacement(place);
        const Vector3d defect = results.displacementDefect(
            {place.element, body.surface.parameters(place).parameters}, u, p, body.material);
        sum.defect += weight * defect.squaredNorm();
        sum.error += weight * error.squaredNorm();
        sum.iterate += weight * (error - defect).squaredNorm();
        sum.scale += weight * exact.displacement(jet.position).squaredNorm();
        sum.largestDefect = std::max(sum.largestDefect, defect.norm());
        sum.largestError = std::max(sum.largestError, error.norm());
      });
  for (double* value : {&sum.defect, &sum.error, &sum.iterate})
    *value = std::sqrt(*value / sum.scale);
  return sum;
}

[[maybe_unused]] void tell(const char* name, const SplineBody& body, const Estimate& estimate) {
  std::printf(
      "%-14s n %4d  error %.2e  defect %.2e (%.2f)  iterate %.2e  largest: defect/error %.2f\n",
      name, body.surface.coefficientCount(), estimate.error, estimate.defect,
      estimate.defect / estimate.error, estimate.iterate,
      estimate.largestDefect / estimate.largestError);
}

void correct(const char* name, const SplineBody& body, const ExactField& exact, int perDirection) {
  const SplineResults results(body.surface, body.tractions);
  const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
  const DegreesOfFreedom& dofs = body.problem->dofs();
  auto points = grevilleCollocation(body.surface);
  for (const int slot : dofs.extraSlots())
    points.push_back(shiftedCollocation(body.surface, body.tractions, slot));
  const WrittenOut written(
      assemble<double>(body.surface, body.tractions, points, body.material, {1e-6}, Job{}), dofs);
  const int n = body.surface.coefficientCount(), m = static_cast<int>(points.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, 3);
  VectorXd areas = VectorXd::Zero(n);
  std::vector<double> basis;
  std::vector<std::pair<SplinePlace, Vector3d>> defects;
  visitSplinePoints(body.surface, elementsWhere(body.surface, anywhere), perDirection, INFINITY,
                    [&](const SplinePlace& place, const SplineJet&, double weight) {
                      const Vector3d defect = results.displacementDefect(
                          {place.element, body.surface.parameters(place).parameters}, u, p,
                          body.material);
                      defects.push_back({place, defect});
                      body.surface.evaluateBasis(place, basis);
                      for (std::size_t f = 0; f < basis.size(); ++f) {
                        const int k = body.surface.functions(place.element)[f];
                        sums.row(k) += weight * basis[f] * 0.5 * defect.transpose();
                        areas[k] += weight * basis[f];
                      }
                    });
  VectorXd r = VectorXd::Zero(3 * m);
  for (int k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c) r[c * m + k] = sums(k, c) / areas[k];
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(written.A);
  const BoundaryField delta = dofs.expand(lu.solve(r), Eigen::MatrixXd());
  double error = 0, found = 0, left = 0, both = 0, scale = 0;
  std::size_t next = 0;
  visitSplinePoints(
      body.surface, elementsWhere(body.surface, anywhere), perDirection, INFINITY,
      [&](const SplinePlace& place, const SplineJet& jet, double weight) {
        const Vector3d true_ = exact.displacement(jet.position) - body.displacement(place);
        body.surface.evaluateBasis(place, basis);
        Vector3d change = Vector3d::Zero();
        for (std::size_t f = 0; f < basis.size(); ++f)
          change +=
              basis[f] * delta.u.col(0).segment<3>(3 * body.surface.functions(place.element)[f]);
        error += weight * true_.squaredNorm();
        found += weight * change.squaredNorm();
        left += weight * (true_ - change).squaredNorm();
        both += weight * (change + defects[next++].second).squaredNorm();
        scale += weight * exact.displacement(jet.position).squaredNorm();
      });
  std::printf(
      "%-14s n %4d error %.2e  correction/error %.2f  left/error %.2f correction+defect/error "
      "%.2f\n",
      name, n, std::sqrt(error / scale), std::sqrt(found / error), std::sqrt(left / error),
      std::sqrt(both / error));
}

TEST(SplineDefect, Explore) {
  for (const double nu : {0.3}) {
    const Material material{0.1, nu};
    const auto series = [&](const char* name, modeling::Solid fine, int count, const auto& held,
                            const ExactField& field) {
      for (int k = 0; k < count; ++k) {
        const SplineBody body(heldWhere(app::splineSurfaceOf(fine), held), material, field, {1e-6});
        for (int q : {2, 3})
          if (q == 2 || k < 3) correct(name, body, field, q);
        fine = halved(fine);
      }
    };
    const ExactField exact = kelvinField({20, 15, 40}, kForce, material);
    series("sphere5", modeling::makeSphere(25, 5), 1, isBelow, exact);
    series("sphere7", modeling::makeSphere(25, 7), 1, isBelow, exact);
    series("sphere9", modeling::makeSphere(25, 9), 1, isBelow, exact);
    const auto bottom = [](const Vector3d& x) { return x.z() < 1e-6; };
    series("box", modeling::makeBox({40, 30, 20}), 3, bottom,
           kelvinField({10, 5, 35}, kForce, material));
    series(
        "box3", modeling::makeBox({40, 30, 20}), 3,
        [](const Vector3d& x) { return x.z() < 1e-6 || x.x() < -20 + 1e-6 || x.y() < -15 + 1e-6; },
        kelvinField({10, 5, 35}, kForce, material));
    series("cylinder", modeling::makeCylinder(20, 60), 2, bottom,
           kelvinField({35, 10, 40}, {0.03, 0.02, -0.05}, material));
    const auto base = [](const Vector3d& x) { return x.x() < -50 + 1e-6; };
    series("rod tip", modeling::makeBox({100, 10, 10}), 4, base,
           kelvinField({40, 3, 25}, kForce, material));
    series("rod root", modeling::makeBox({100, 10, 10}), 3, base,
           kelvinField({-45, 3, 25}, kForce, material));
    series(
        "plate", modeling::makeBox({60, 60, 4}), 4,
        [](const Vector3d& x) { return x.x() < -30 + 1e-6; },
        kelvinField({20, 3, 15}, kForce, material));
  }
}

}  // namespace
}  // namespace palpa::bem::test
