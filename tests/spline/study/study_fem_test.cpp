// Finite element solutions of fem.json (two independent programs that agree to 0.03 % of the
// largest displacement), whose tractions are singular along the rims of supports: splines with
// graded knots against triangles refined towards the borders of supports. The error of u is the
// root mean square over the points of the file.
#include <gtest/gtest.h>

#include <cmath>

#include "bem/dense/make_reference_problem.h"
#include "bem/triangle/results.h"
#include "modeling/shapes/primitives.h"
#include "spline_fem.h"
#include "study_solutions.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr const char* kGraded = "cubic splines, graded";
constexpr const char* kRefined = "triangles, refined";

StudyStep stepOf(const FemSolution& solution, bool hasLoad) {
  StudyStep step;
  step.coefficients = solution.coefficients;
  step.elements = solution.elements;
  step.size = solution.size;
  step.error = solution.errors.points;
  if (hasLoad) step.atLoad = solution.errors.atLoad;
  step.reaction = solution.errors.reaction;
  step.assemble = solution.times.assemble;
  step.factorise = solution.times.factorise;
  return step;
}

/// Solid that is fixed (tag 1) and moved (tag 2) in regions, with the prescribed displacements.
struct Case {
  std::string name;
  json reference;
  modeling::Solid solid;
  std::vector<modeling::MeshRegion> fixed;
  Vector3d top = Vector3d::Zero();
  bool isRefined = true;  ///< true: triangles are refined towards the borders of supports

  bool hasLoad() const { return reference.contains("load"); }
  SplineFunction load() const { return hasLoad() ? bumpOf(reference) : SplineFunction(); }
  double loadRadius() const { return hasLoad() ? reference["load"]["a"].get<double>() : INFINITY; }
  Vector3d given(const Vector3d& x) const { return x.z() > 30 ? top : Vector3d::Zero().eval(); }
};

FemSolution solveTriangles(const Case& of, double edgeLength) {
  const BoundaryMesh mesh = triangleMesh(of.solid, edgeLength, of.fixed, of.isRefined);
  const TractionSlots slots(mesh);
  BoundaryConditions conditions(mesh, slots);
  for (int s = 0; s < slots.count(); ++s)
    if (slots.slots[s].tag != 0) conditions.ofSlot[s] = SlotCondition::kFixed;
  for (int k = 0; k < mesh.nodeCount(); ++k)
    conditions.displacement.segment<3>(3 * k) = of.given(mesh.nodes[k]);
  if (of.hasLoad())
    conditions.traction =
        projectTraction(mesh, slots, {allTriangles(mesh), of.load(), of.loadRadius()});
  const Material material{of.reference["material"]["E"], of.reference["material"]["nu"]};
  FemSolution solution;
  const auto problem = makeDenseReferenceProblem(
      mesh, slots, {conditions.ofSlot, material, {}, Precision::kAutomatic}, Job{},
      &solution.times);
  const BoundaryField field = problem->solveField(problem->dofs().knownField(conditions));
  const Eigen::VectorXd u = field.u.col(0), p = field.p.col(0);
  std::vector<Vector3d> displacements;
  for (const json& point : of.reference["points"]) {
    const SurfacePoint place = nearestSurfacePoint(mesh, vectorOf(point["x"]));
    displacements.push_back(mesh.tags[place.triangle] != 0
                                ? of.given(place.position)
                                : surfaceDisplacement(mesh, slots, u, p, material, place));
  }
  solution.coefficients = mesh.nodeCount();
  solution.elements = mesh.triangleCount();
  solution.size = std::sqrt(mesh.surfaceArea() / solution.elements);
  solution.errors = FemErrors(of.reference, displacements,
                              tractionResultant(mesh, slots, p, trianglesWithTag(mesh, 1)).force,
                              strainEnergy(mesh, slots, u, p));
  return solution;
}

template <class Solve>
StudyStep fastestStep(const Case& of, const Solve& solve) {
  return stepOf(*fastest([&] { return std::make_unique<FemSolution>(solve()); }), of.hasLoad());
}

StudySeries triangleSeries(const Case& of, const std::vector<double>& edgeLengths) {
  StudySeries series{of.name, of.isRefined ? kRefined : kTriangles, {}};
  for (const double edgeLength : edgeLengths)
    series.steps.push_back(fastestStep(of, [&] { return solveTriangles(of, edgeLength); }));
  report(series);
  return series;
}

StudySeries splineSeries(const Case& of, const std::vector<SplineSurface>& surfaces) {
  StudySeries series{of.name, kGraded, {}};
  const auto given = [&](const Vector3d& x) { return of.given(x); };
  for (const SplineSurface& surface : surfaces)
    series.steps.push_back(fastestStep(
        of, [&] { return solveFem(of.reference, surface, given, of.load(), of.loadRadius()); }));
  report(series);
  return series;
}

/// Checks that the finest splines are more accurate than the finest triangles, with fewer
/// coefficients.
void expectBetter(const StudySeries& splines, const StudySeries& triangles) {
  EXPECT_LE(splines.last().coefficients, 1200);
  EXPECT_LT(splines.last().coefficients, triangles.last().coefficients);
  EXPECT_LT(splines.last().error, triangles.last().error);
  EXPECT_LE(splines.last().reaction, 3e-3);
}

TEST(SplineStudy, FiniteElementsCylinderPushedAtItsSide) {
  const Case pushed{"cylinder pushed at its side",
                    femCase("a_cyl_side"),
                    modeling::makeCylinder(20, 60),
                    {{"base", modeling::Region::ofPatches({"bottom"})}}};
  const StudySeries triangles = triangleSeries(pushed, {7, 5, 3.6});
  const StudySeries splines = splineSeries(
      pushed,
      {fixedCylinder(cylinderWithKnots({5, 17, 26, 34, 45}, {0.1, 0.9}), false),
       fixedCylinder(cylinderWithKnots({2.5, 7, 15, 22, 26, 30, 34, 38, 46}, {0.06, 0.94}), false),
       fixedCylinder(cylinderWithKnots({0.7, 2.5, 6, 11, 17, 22, 26, 30, 34, 38, 43, 51},
                                       {0.04, 0.125, 0.375, 0.625, 0.875, 0.96}),
                     false)});
  expectBetter(splines, triangles);
}

TEST(SplineStudy, FiniteElementsSpherePushedAtItsPole) {
  const Case pushed{"sphere pushed at its pole",
                    femCase("c_sph_pole"),
                    modeling::makeSphere(25),
                    {{"base", modeling::Region::below(Vector3d::UnitZ(), -20)}},
                    Vector3d::Zero(),
                    false};
  const StudySeries triangles = triangleSeries(pushed, {4, 2.9, 2.1});
  const StudySeries splines = splineSeries(
      pushed, {fixedSphere(7, {0.06, 0.94}), fixedSphere(8, {0.05, 0.13, 0.42, 0.58, 0.87, 0.95}),
               fixedSphere(9, {0.04, 0.08, 0.12, 0.42, 0.58, 0.88, 0.92, 0.96})});
  expectBetter(splines, triangles);
}

TEST(SplineStudy, FiniteElementsCylinderBetweenBondedPlates) {
  for (const char* id : {"b_cyl_push_nu0.30", "b_cyl_push_nu0.45"}) {
    const json reference = femCase(id);
    Case pressed{std::string("cylinder between bonded plates, nu ") + (id + 13),
                 reference,
                 modeling::makeCylinder(20, 60),
                 {{"base", modeling::Region::ofPatches({"bottom"})},
                  {"top", modeling::Region::ofPatches({"top"})}},
                 vectorOf(reference["top"])};
    const StudySeries triangles = triangleSeries(pressed, {9, 6, 4.2});
    const StudySeries splines = splineSeries(
        pressed, {fixedCylinder(cylinderWithKnots({5, 18, 42, 55}, {}), true),
                  fixedCylinder(cylinderWithKnots({2.5, 8, 18, 42, 52, 57.5}, {0.06, 0.94}), true),
                  fixedCylinder(cylinderWithKnots({0.7, 2.5, 6, 12, 20, 30, 40, 48, 54, 57.5, 59.3},
                                                  {0.04, 0.125, 0.375, 0.625, 0.875, 0.96}),
                                true)});
    expectBetter(splines, triangles);
  }
}

}  // namespace
}  // namespace palpa::bem::test
