#include "spline_fem.h"
#include "bem/dense/make_reference_problem.h"

#include <algorithm>
#include <cmath>

#include "app/core/setup/to_spline_surface.h"
#include "bem/spline/surface_part.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::bem::test {

using Eigen::Vector3d;
using nlohmann::json;

namespace {

constexpr double kHeight = 60;  ///< mm, of the cylinder

}  // namespace

modeling::Solid withKnots(modeling::Solid solid, const std::string& patch, int direction,
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

modeling::Solid cylinderWithKnots(const std::vector<double>& heights,
                                  const std::vector<double>& fractions) {
  modeling::Solid solid = modeling::makeCylinder(20, kHeight);
  const modeling::Patch& side = solid.patches()[*solid.findPatch("side_xmax")];
  const bool isUpwards = solid.controlPoints()[side.net.front().front()].z() < kHeight / 2;
  std::vector<double> ofHeight;
  for (const double z : heights) ofHeight.push_back(isUpwards ? z / kHeight : 1 - z / kHeight);
  solid = withKnots(std::move(solid), "side_xmax", 1, ofHeight);
  for (const char* patch : {"side_xmax", "side_ymax"})
    solid = withKnots(std::move(solid), patch, 0, fractions);
  return solid;
}

SplineSurface fixedCylinder(const modeling::Solid& cylinder, bool atTop) {
  SplineSurface surface =
      fixedWhere(app::splineSurfaceOf(cylinder), [](const Vector3d& x) { return x.z() < 1e-6; });
  if (!atTop) return surface;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplineElement& element = surface.elements()[e];
    const ElementPlace middle{e, (element.lower[0] + element.upper[0]) / 2,
                              (element.lower[1] + element.upper[1]) / 2};
    if (surface.evaluate(middle).position.z() > kHeight - 1e-6) surface.setTag(e, 2);
  }
  return surface;
}

SplineSurface fixedSphere(int controlPoints, const std::vector<double>& fractions) {
  modeling::Solid solid = modeling::makeSphere(25, controlPoints);
  for (const int d : {0, 1}) solid = withKnots(std::move(solid), "top", d, fractions);
  return withPart(
      app::splineSurfaceOf(solid), [](const Vector3d& x) { return x.z() + 20; }, 1,
      Tearing::kRoots);
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

FemSolution solveFem(const json& reference, const SplineSurface& surface,
                     const std::function<Vector3d(const Vector3d&)>& given,
                     const SplineFunction& load, double loadRadius) {
  const Material material{reference["material"]["E"], reference["material"]["nu"]};
  const SplineTractions tractions(surface);
  BoundaryConditions conditions(surface.coefficientCount(), tractions.slots.count());
  for (int s = 0; s < tractions.slots.count(); ++s)
    if (const auto& slot = tractions.slots.slots[s];
        slot.tag != 0 && !surface.barelyReaches(slot.node, slot.tag, slot.smoothingGroup))
      conditions.ofSlot[s] = SlotCondition::kFixed;
  for (int k = 0; k < surface.coefficientCount(); ++k)
    conditions.displacement.segment<3>(3 * k) = given(surface.controlPoints()[k]);
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  if (load) conditions.traction = projectTraction(surface, tractions, all, load, loadRadius);
  ReferenceProblemTimes times;
  const auto problem = makeDenseReferenceProblem(
      surface, tractions, {conditions.ofSlot, material, {1e-5}, Precision::kAutomatic}, Job{},
      &times);
  const BoundaryField field = problem->solveField(problem->dofs().knownField(conditions));

  FemSolution solution;
  solution.coefficients = surface.coefficientCount();
  solution.elements = surface.elementCount();
  solution.times = times;
  std::vector<double> basis;
  const auto at = [&](const ElementPlace& place, const Eigen::VectorXd& values,
                      const std::vector<int>& indices) {
    surface.evaluateBasis(place, basis);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t f = 0; f < basis.size(); ++f)
      sum += basis[f] * values.segment<3>(3 * indices[f]);
    return sum;
  };
  std::vector<Vector3d> displacements;
  for (const json& point : reference["points"]) {
    const ElementPlace place = nearestPlace(surface, vectorOf(point["x"]));
    displacements.push_back(at(place, field.u, surface.functions(place.element)));
  }
  Vector3d reaction = Vector3d::Zero();
  double energy = 0, area = 0;
  visitSplinePoints(surface, all, 5, loadRadius / 8,
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      surface.evaluateTractionBasis(place, basis);
                      const Vector3d p =
                          weightedSum(basis, tractions.ofFunction[place.element], field.p);
                      const Vector3d u = at(place, field.u, surface.functions(place.element));
                      area += weight;
                      energy += weight * p.dot(u) / 2;
                      if (surface.elements()[place.element].tag == 1) reaction += weight * p;
                    });
  solution.size = std::sqrt(area / solution.elements);
  solution.errors = FemErrors(reference, displacements, reaction, energy);
  return solution;
}

}  // namespace palpa::bem::test
