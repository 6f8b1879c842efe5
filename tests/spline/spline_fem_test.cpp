// The finite element solutions of data/fem.json whose supports are whole patches, with splines that
// are graded towards the clamped rim.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/core/spline_surface_of.h"
#include "bem/spline/spline_projection.h"
#include "bem/spline/surface_part.h"
#include "fem_case.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/knot_operations.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using palpa::test::femCase;
using palpa::test::vectorOf;

/// Inserts knots at fractions of the range of one direction of a patch, from its lower or upper
/// end.
modeling::Solid graded(modeling::Solid solid, const std::string& patch, int direction,
                       const std::vector<double>& fractions) {
  const int index = *solid.findPatch(patch);
  for (const double fraction : fractions) {
    const auto [lower, upper] = solid.patches()[index].range(direction);
    const double at = lower + fraction * (upper - lower);
    const auto& knots = solid.patches()[index].knots[direction];
    if (std::none_of(knots.begin(), knots.end(),
                     [&](double k) { return std::abs(k - at) < 1e-9 * (upper - lower); }))
      solid = modeling::insertKnot(solid, {index, direction}, at);
  }
  return solid;
}

/// Knots of the sides at these heights (mm), and in the caps near the rim.
modeling::Solid cylinderWithKnotsAt(const std::vector<double>& heights) {
  modeling::Solid solid = modeling::makeCylinder(20, 60);
  const SplineSurface surface = app::splineSurfaceOf(solid);
  const int side = *solid.findPatch("side_xmax");
  const SplinePlace corner{surface.elementsAt(side, 0, 0).front(),
                           solid.patches()[side].range(0)[0], solid.patches()[side].range(1)[0]};
  const bool isUpwards = surface.evaluate(corner).position.z() < 30;
  std::vector<double> fractions;
  for (const double z : heights) fractions.push_back(isUpwards ? z / 60 : 1 - z / 60);
  solid = graded(std::move(solid), "side_xmax", 1, fractions);
  for (const char* patch : {"side_xmax", "side_ymax"})
    solid = graded(std::move(solid), patch, 0, {0.04, 0.125, 0.375, 0.625, 0.875, 0.96});
  return solid;
}

struct FemErrors {
  double atLoad = 0, anywhere = 0, reaction = 0, energy = 0;
  int coefficients = 0;
};

/// `given`: displacement of the held elements (tags 1 and 2) by control point; they take constants.
FemErrors solve(const json& reference, const SplineSurface& surface,
                const std::function<Vector3d(const Vector3d&)>& given, const SplineFunction& load,
                double loadRadius) {
  const Material material{reference["material"]["E"], reference["material"]["nu"]};
  const SplineTractions tractions(surface);
  BoundaryConditions conditions(surface.coefficientCount(), tractions.slots.count());
  for (int s = 0; s < tractions.slots.count(); ++s)
    if (tractions.slots.slots[s].tag != 0 &&
        !surface.barelyReaches(tractions.slots.slots[s].node, tractions.slots.slots[s].tag))
      conditions.ofSlot[s] = SlotCondition::kFixed;
  for (int k = 0; k < surface.coefficientCount(); ++k)
    conditions.displacement.segment<3>(3 * k) = given(surface.controlPoints()[k]);
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  if (load) conditions.traction = projectTraction(surface, tractions, all, load, loadRadius);
  ReferenceProblemTimes times;
  const auto problem = makeDenseReferenceProblem(surface, tractions, conditions.ofSlot, material,
                                                 {1e-5}, Precision::kDouble, Job{}, &times);
  const BoundaryField field = problem->solveField(problem->dofs().knownField(conditions));

  FemErrors errors;
  errors.coefficients = surface.coefficientCount();
  std::vector<double> basis;
  const auto at = [&](const SplinePlace& place, const Eigen::VectorXd& values,
                      const std::vector<int>& indices) {
    surface.evaluateBasis(place, basis);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t f = 0; f < basis.size(); ++f)
      sum += basis[f] * values.segment<3>(3 * indices[f]);
    return sum;
  };
  double largest = 0;
  for (const json& point : reference["points"])
    largest = std::max(largest, vectorOf(point["u"]).norm());
  for (std::size_t k = 0; k < reference["points"].size(); ++k) {
    const json& point = reference["points"][k];
    const SplinePlace place = nearestPlace(surface, vectorOf(point["x"]));
    const Vector3d u = at(place, field.u, surface.functions(place.element));
    const double error = (u - vectorOf(point["u"])).norm();
    errors.anywhere = std::max(errors.anywhere, error / largest);
    if (k == 0) errors.atLoad = error / vectorOf(point["u"]).norm();
  }
  Vector3d reaction = Vector3d::Zero();
  double energy = 0;
  visitSplinePoints(surface, all, 5, loadRadius / 8,
                    [&](const SplinePlace& place, const SplineJet&, double weight) {
                      const Vector3d p = at(place, field.p, tractions.ofFunction[place.element]);
                      const Vector3d u = at(place, field.u, surface.functions(place.element));
                      energy += weight * p.dot(u) / 2;
                      if (surface.elements()[place.element].tag == 1) reaction += weight * p;
                    });
  const Vector3d expected = vectorOf(reference["reaction_force"]);
  errors.reaction = (reaction - expected).norm() / expected.norm();
  const double exactEnergy = reference["energy_mJ"];
  errors.energy = std::abs(energy - exactEnergy) / exactEnergy;
  std::printf("%s n %d: at load %.2e anywhere %.2e reaction %.2e energy %.2e (%.2f + %.2f s)\n",
              reference["id"].get<std::string>().c_str(), errors.coefficients, errors.atLoad,
              errors.anywhere, errors.reaction, errors.energy, times.assemble, times.factorise);
  return errors;
}

SplineFunction bumpOf(const json& reference) {
  const json& load = reference["load"];
  const Vector3d center = vectorOf(load["center"]), direction = vectorOf(load["direction"]);
  const double radius = load["a"], peak = load["p0"];
  return [=](const Vector3d& x, const Vector3d&) {
    const double rest = 1 - (x - center).squaredNorm() / (radius * radius);
    return Vector3d(direction * (rest > 0 ? peak * rest * rest : 0));
  };
}

TEST(SplineFem, CylinderPushedAtItsSide) {
  const json reference = femCase("a_cyl_side");
  SplineSurface surface =
      app::splineSurfaceOf(cylinderWithKnotsAt({0.7, 2.5, 6, 11, 17, 22, 26, 30, 34, 38, 43, 51}));
  surface = heldWhere(std::move(surface), [](const Vector3d& x) { return x.z() < 1e-6; });
  const FemErrors errors = solve(
      reference, surface, [](const Vector3d&) { return Vector3d::Zero().eval(); },
      bumpOf(reference), reference["load"]["a"]);
  EXPECT_LE(errors.coefficients, 1200);
  EXPECT_LE(errors.atLoad, 5e-3);
  EXPECT_LE(errors.anywhere, 5e-3);
  EXPECT_LE(errors.reaction, 3e-3);
  EXPECT_LE(errors.energy, 1e-2);
}

TEST(SplineFem, SphereHeldInAHalfSpaceThatCutsItsPatches) {
  const json reference = femCase("c_sph_pole");
  // Finer at the load and, in the bands around the bottom, where the border of the support runs.
  modeling::Solid solid = modeling::makeSphere(25, 9);
  for (const int d : {0, 1})
    solid = graded(std::move(solid), "top", d, {0.04, 0.08, 0.12, 0.42, 0.58, 0.88, 0.92, 0.96});
  const SplineSurface surface = withPart(
      app::splineSurfaceOf(solid), [](const Vector3d& x) { return x.z() + 20; }, 1);
  const FemErrors errors = solve(
      reference, surface, [](const Vector3d&) { return Vector3d::Zero().eval(); },
      bumpOf(reference), reference["load"]["a"]);
  EXPECT_LE(errors.coefficients, 1200);
  EXPECT_LE(errors.atLoad, 6e-3);
  EXPECT_LE(errors.anywhere, 1e-2);
  EXPECT_LE(errors.reaction, 3e-3);
  EXPECT_LE(errors.energy, 1e-2);
}

TEST(SplineFem, CylinderPressedBetweenBondedPlates) {
  for (const char* id : {"b_cyl_push_nu0.30", "b_cyl_push_nu0.45"}) {
    const json reference = femCase(id);
    SplineSurface surface = app::splineSurfaceOf(
        cylinderWithKnotsAt({0.7, 2.5, 6, 12, 20, 30, 40, 48, 54, 57.5, 59.3}));
    surface = heldWhere(std::move(surface), [](const Vector3d& x) { return x.z() < 1e-6; });
    for (int e = 0; e < surface.elementCount(); ++e) {
      const SplineElement& element = surface.elements()[e];
      const SplinePlace middle{e, (element.lower[0] + element.upper[0]) / 2,
                               (element.lower[1] + element.upper[1]) / 2};
      if (surface.evaluate(middle).position.z() > 60 - 1e-6) surface.setTag(e, 2);
    }
    const Vector3d top = vectorOf(reference["top"]);
    const FemErrors errors = solve(
        reference, surface,
        [&](const Vector3d& x) { return Vector3d(x.z() > 30 ? top : Vector3d::Zero()); }, {},
        INFINITY);
    EXPECT_LE(errors.coefficients, 1200);
    EXPECT_LE(errors.anywhere, 5e-3);
    EXPECT_LE(errors.reaction, 3e-3);
    EXPECT_LE(errors.energy, 1e-2);
  }
}

}  // namespace
}  // namespace palpa::bem::test
