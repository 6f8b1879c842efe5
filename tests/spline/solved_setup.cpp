#include "solved_setup.h"
#include "bem/dense/make_reference_problem.h"

#include <cmath>

#include "bem/spline/spline_projection.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"

namespace palpa::app::test {
namespace {

using Eigen::Vector3d;

constexpr double kFingertip = 6.0;  // mm

Vector3d at(const BoundarySetup& setup, const bem::ElementPlace& place,
            const Eigen::MatrixXd& values, const std::vector<int>& indices) {
  std::vector<double> basis;
  setup.splines->surface().evaluateBasis(place, basis);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t f = 0; f < basis.size(); ++f)
    sum += basis[f] * values.block<3, 1>(3 * indices[f], 0);
  return sum;
}

}  // namespace

BoundarySetup setupOf(const modeling::Project& project, const SplineRefinement& net) {
  const ProjectGeometry geometry(project, net);
  return makeSplineSetup(geometry, modeling::mesh(project.body, project.mesh, geometry.regions()));
}

BoundarySetup setupOf(const modeling::Project& project) {
  const modeling::SurfaceEvaluator surface(std::get<modeling::Solid>(project.body));
  return setupOf(project,
                 splineRefinement(project, surface, ElementSizes::of(project.mesh, kFingertip)));
}

SolvedSetup::SolvedSetup(BoundarySetup made) : setup(std::move(made)) {
  const auto problem = bem::makeDenseReferenceProblem(
      *setup.discretisation,
      {setup.conditions.ofSlot, setup.material, {1e-5}, bem::Precision::kDouble}, Job{}, &times);
  field = problem->solveField(problem->dofs().knownField(setup.conditions));
}

Vector3d SolvedSetup::u(const bem::ElementPlace& place) const {
  return at(setup, place, field.u, surface().functions(place.element));
}

Vector3d SolvedSetup::p(const bem::ElementPlace& place) const {
  std::vector<double> basis;
  surface().evaluateTractionBasis(place, basis);
  return bem::weightedSum(basis, setup.splines->tractions().ofFunction[place.element],
                          field.p.col(0));
}

Vector3d SolvedSetup::reaction(int support) const {
  Vector3d sum = Vector3d::Zero();
  bem::visitSplinePoints(
      surface(), setup.supports[support].elements, 5, INFINITY,
      [&](const auto& place, const auto&, double weight) { sum += weight * p(place); });
  return sum;
}

modeling::Project boxOfSplines() {
  modeling::Project project;
  project.material = {"", 0.1, 0.3};
  project.body = modeling::makeBox({40, 30, 20});
  project.mesh.edgeLength = 5;
  return project;
}

}  // namespace palpa::app::test
