// Supports whose borders cut patches anywhere: exact fields, and forces that must balance.

#include <algorithm>

#include "app/core/setup/boundary_setup.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/surface_part.h"
#include "modeling/mesh/mesh.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using modeling::Project;
using modeling::Region;
using modeling::Support;

const Material kMaterial{0.1, 0.3};

/// Largest error of u, over the least possible one, of a body fixed below planes at different
/// heights, with the field of a point force outside as data.
double worstOverLeast(const SplineSurface& surface, const Vector3d& source,
                      const Vector3d& across) {
  const ExactField exact = kelvinField(source, {0.03, -0.02, 0.06}, kMaterial);
  const Vector3d axis = across.normalized();
  double low = INFINITY, high = -INFINITY;
  for (const Vector3d& point : surface.controlPoints()) {
    low = std::min(low, point.dot(axis));
    high = std::max(high, point.dot(axis));
  }
  double worst = 0;
  for (const double part : {0.31, 0.44, 0.65, 0.86}) {
    const double level = low + part * (high - low);
    const SplineBody body(withPart(
                              surface, [&](const Vector3d& x) { return x.dot(axis) - level; }, 1),
                          kMaterial, exact, {1e-5});
    worst = std::max(worst, body.displacementError(exact) / body.leastDisplacementError(exact));
  }
  return worst;
}

TEST(SupportBorder, MayCutPatchesAtAnyHeightAndAngle) {
  const SplineSurface sphere = app::splineSurfaceOf(modeling::makeSphere(25, 9));
  const SplineSurface box = app::splineSurfaceOf(halved(modeling::makeBox({40, 30, 20})));
  for (const Vector3d& across :
       {Vector3d(0, 0, 1), Vector3d(0.3, -0.5, 1), Vector3d(-0.8, 0.1, 0.3)}) {
    const double ofSphere = worstOverLeast(sphere, {20, 15, 40}, across);
    const double ofBox = worstOverLeast(box, {40, 25, 45}, across);
    std::printf("error over least: sphere %.2f, box %.2f\n", ofSphere, ofBox);
    EXPECT_LT(ofSphere, 2);
    EXPECT_LT(ofBox, 6);
  }
}

TEST(SupportBorder, EquationsAreCollocationWhereNothingIsCut) {
  const SplineSurface whole = app::splineSurfaceOf(modeling::makeSphere(25, 9));
  const WeightedEquations collocation = splineEquations(whole, SplineTractions(whole), {});
  EXPECT_TRUE(collocation.isCollocation());
  const SplineSurface cut = withPart(
      whole, [](const Vector3d& x) { return x.z() + 20; }, 1);
  const WeightedEquations equations = splineEquations(cut, SplineTractions(cut), {});
  EXPECT_FALSE(equations.isCollocation());
  const Eigen::VectorXd sums = equations.weights * Eigen::VectorXd::Ones(equations.weights.cols());
  EXPECT_LT((sums.array() - 1).abs().maxCoeff(), 1e-12);
  int collocated = 0;
  const Eigen::SparseMatrix<double> ofPoint = equations.weights.transpose();
  for (int k = 0; k < cut.coefficientCount(); ++k) {
    const auto points = ofPoint.col(k).nonZeros();
    EXPECT_EQ(points == 1, !cut.isTorn(k)) << k;
    collocated += points == 1 ? 1 : 0;
  }
  EXPECT_GT(collocated, cut.coefficientCount() / 4);
}

/// Force of the support and the load that it bears.
struct Forces {
  Vector3d support, load;
};

Forces forces(const modeling::Body& shape, const Vector3d& normal, double below, double top,
              double elementLength, Precision precision) {
  Project project;
  project.material = {"", 0.1, 0.3};
  project.body = shape;
  project.supports = {{"base", Support::Kind::kFixed, Region::below(normal, below), {0, 0, 0}}};
  project.loads = {{"bump", modeling::Bump{{0, 0, top}, 8, 0.02, {0.2, 0, -1}}}};
  project.mesh.engine = modeling::Engine::kSplines;
  project.mesh.edgeLength = 4;
  project.mesh.elementLength = elementLength;
  const app::BoundarySetup setup = app::makeBoundarySetup(
      app::ProjectGeometry(project),
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
  const SplineSurface& surface = setup.splines->surface();
  const auto problem = makeDenseReferenceProblem(
      *setup.discretisation, {setup.conditions.ofSlot, setup.material, {1e-5}, precision});
  const BoundaryField field = problem->solveField(problem->dofs().knownField(setup.conditions));
  Forces result{Vector3d::Zero(), setup.loads[0].resultant.force};
  std::vector<double> basis;
  visitSplinePoints(surface, setup.supports[0].elements, 5, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      surface.evaluateTractionBasis(place, basis);
                      for (std::size_t f = 0; f < basis.size(); ++f)
                        result.support +=
                            weight * basis[f] *
                            field.p.block<3, 1>(
                                3 * setup.splines->tractions().ofFunction[place.element][f], 0);
                    });
  return result;
}

/// Real supports, whose tractions are singular along the border: what they bear is what is loaded.
TEST(SupportBorder, SupportsBearTheLoad) {
  const auto expectBalance = [](const Forces& found, double tolerance) {
    EXPECT_LT((found.support + found.load).norm(), tolerance * found.load.norm());
  };
  const modeling::Body box = modeling::makeBox({40, 30, 20}), sphere = modeling::makeSphere(25, 9);
  for (const Precision precision : {Precision::kDouble, Precision::kMixed, Precision::kSingle}) {
    expectBalance(forces(box, {0.3, -0.2, 1}, 7, 20, 8, precision), 1e-3);
    // Collocation does not balance forces exactly.
    expectBalance(forces(sphere, {0, 0, 1}, -5, 25, 8, precision), 2e-3);
  }
  expectBalance(forces(box, {1, 0.2, 0.3}, -4, 20, 6, Precision::kDouble), 1e-3);
  // Along a line of knots: no element is cut, but functions reach across.
  expectBalance(forces(modeling::makeBox({40, 30, 8}), {0, 0, 1}, 4, 8, 4, Precision::kDouble),
                1e-3);
}

}  // namespace
}  // namespace palpa::bem::test
