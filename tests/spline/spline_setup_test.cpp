// From projects to the spline discretisation: the finite element solutions of data/fem.json with
// knots chosen automatically, the parts of supports and loads, rollers.
#include "app/core/spline_setup.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bem/reference_problem.h"
#include "bem/spline/spline_projection.h"
#include "fem_case.h"
#include "modeling/shapes/primitives.h"
#include "spline_body.h"

namespace palpa::app {
namespace {

using bem::Material;
using Eigen::Vector3d;
using modeling::Project;
using modeling::Region;
using modeling::Support;
using nlohmann::json;
using palpa::test::femCase;
using palpa::test::vectorOf;

constexpr double kFingertip = 6.0;  // mm

SplineSetup setupOf(const Project& project, const AnalysisNet& net) {
  return makeSplineSetup(
      project, modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)), net);
}

struct Solved {
  SplineSetup setup;
  bem::ReferenceProblemTimes times;
  bem::BoundaryField field;

  Solved(SplineSetup s, const modeling::Material& material) : setup(std::move(s)) {
    const auto problem =
        bem::makeDenseReferenceProblem(setup.surface, setup.tractions, setup.conditions.ofSlot,
                                       {material.youngsModulus, material.poissonRatio}, {1e-5},
                                       bem::Precision::kDouble, bem::Job{}, &times);
    field = problem->solveField(problem->dofs().knownField(setup.conditions));
  }
  Vector3d at(const bem::SplinePlace& place, const Eigen::MatrixXd& values,
              const std::vector<int>& indices) const {
    std::vector<double> basis;
    setup.surface.evaluateBasis(place, basis);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t f = 0; f < basis.size(); ++f)
      sum += basis[f] * values.block<3, 1>(3 * indices[f], 0);
    return sum;
  }
  Vector3d u(const bem::SplinePlace& place) const {
    return at(place, field.u, setup.surface.functions(place.element));
  }
  Vector3d p(const bem::SplinePlace& place) const {
    return at(place, field.p, setup.tractions.ofFunction[place.element]);
  }
  Vector3d reaction(int support) const {
    Vector3d sum = Vector3d::Zero();
    bem::visitSplinePoints(
        setup.surface, setup.supports[support].elements, 5, INFINITY,
        [&](const auto& place, const auto&, double weight) { sum += weight * p(place); });
    return sum;
  }
};

struct FemErrors {
  int coefficients = 0;
  double atLoad = 0, anywhere = 0, reaction = 0;
};

double tuned(const char* name, double usual) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : usual;
}

FemErrors femErrors(const std::string& id, double accuracy) {
  const json reference = femCase(id);
  Project project;
  project.material = {"", reference["material"]["E"], reference["material"]["nu"]};
  if (id == "c_sph_pole") {
    project.body = modeling::makeSphere(25);
    project.supports = {{"base", Support::Kind::fixed, Region::below({0, 0, 1}, -20), {0, 0, 0}}};
  } else {
    project.body = modeling::makeCylinder(20, 60);
    project.supports = {{"base", Support::Kind::fixed, Region::ofPatches({"bottom"}), {0, 0, 0}}};
  }
  if (reference.contains("top"))
    project.supports.push_back(
        {"top", Support::Kind::fixed, Region::ofPatches({"top"}), vectorOf(reference["top"])});
  if (reference.contains("load")) {
    const json& load = reference["load"];
    project.loads.push_back({"bump", modeling::Bump{vectorOf(load["center"]), load["a"], load["p0"],
                                                    vectorOf(load["direction"])}});
  }
  project.mesh.edgeLength = 4;
  project.mesh.accuracy = accuracy;
  ElementSizes sizes = ElementSizes::of(project.mesh, kFingertip);
  sizes.interior = tuned("H", sizes.interior);
  sizes.turn = tuned("TURN", sizes.turn);
  sizes.rim = tuned("RIM", sizes.rim);
  sizes.border = tuned("BORDER", sizes.border);
  std::vector<Region> supports;
  for (const Support& support : project.supports) supports.push_back(support.where);
  const AnalysisNet net =
      analysisNet(std::get<modeling::Solid>(project.body), supports, sizes, project.mesh);
  if (std::getenv("KNOTS"))
    for (const auto& chain : net.chains) {
      std::printf("%d.%d:", chain.first.patch, chain.first.direction);
      for (const double knot : chain.knots) std::printf(" %.3f", knot);
      std::printf("\n");
    }
  const auto start = std::chrono::steady_clock::now();
  Solved solved(setupOf(project, net), project.material);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  FemErrors errors;
  errors.coefficients = solved.setup.surface.coefficientCount();
  double largest = 0;
  for (const json& point : reference["points"])
    largest = std::max(largest, vectorOf(point["u"]).norm());
  for (std::size_t k = 0; k < reference["points"].size(); ++k) {
    const json& point = reference["points"][k];
    const auto place = bem::test::nearestPlace(solved.setup.surface, vectorOf(point["x"]));
    const double error = (solved.u(place) - vectorOf(point["u"])).norm();
    errors.anywhere = std::max(errors.anywhere, error / largest);
    if (k == 0) errors.atLoad = error / vectorOf(point["u"]).norm();
  }
  const Vector3d expected = vectorOf(reference["reaction_force"]);
  errors.reaction = (solved.reaction(0) - expected).norm() / expected.norm();
  std::printf(
      "%s %.0e: n %d (net %.0f), slots %d, at load %.2e anywhere %.2e reaction %.2e (%.2f + %.2f "
      "of %.2f s)\n",
      id.c_str(), accuracy, errors.coefficients, net.coefficients,
      solved.setup.tractions.slots.count(), errors.atLoad, errors.anywhere, errors.reaction,
      solved.times.assemble, solved.times.factorise, seconds);
  return errors;
}

TEST(SplineSetup, FiniteElementCasesWithAutomaticKnots) {
  for (const char* id : {"a_cyl_side", "b_cyl_push_nu0.30", "b_cyl_push_nu0.45", "c_sph_pole"}) {
    const FemErrors errors = femErrors(id, tuned("WISH", 3e-3));
    EXPECT_LE(errors.coefficients, 1200);
    EXPECT_LE(errors.atLoad, 5e-3);
    EXPECT_LE(errors.anywhere, 5e-3);
    EXPECT_LE(errors.reaction, 3e-3);
  }
}

}  // namespace
}  // namespace palpa::app
