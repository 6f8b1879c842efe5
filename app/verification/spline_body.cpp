#include "app/verification/spline_body.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/core/setup/to_spline_surface.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_results.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::verification {
using namespace bem;
using Eigen::Vector3d;

namespace {

/// sqrt of ∫ |value - exact|^2 over ∫ |exact|^2.
double relativeError(const SplineSurface& surface,
                     const std::function<Vector3d(const ElementPlace&, const SurfaceJet&)>& value,
                     const std::function<Vector3d(const SurfaceJet&)>& exact) {
  double error = 0, scale = 0;
  visitSplinePoints(surface, allElements(surface), 5, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                      const Vector3d expected = exact(jet);
                      error += weight * (value(place, jet) - expected).squaredNorm();
                      scale += weight * expected.squaredNorm();
                    });
  return std::sqrt(error / scale);
}

/// sum of N_j times the coefficient that belongs to it.
Vector3d sumAt(const SplineSurface& surface, const ElementPlace& place,
               const Eigen::Ref<const Eigen::VectorXd>& coefficients,
               const std::vector<int>& ofFunction) {
  std::vector<double> basis;
  surface.evaluateBasis(place, basis);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t f = 0; f < basis.size(); ++f)
    sum += basis[f] * coefficients.segment<3>(3 * ofFunction[f]);
  return sum;
}

}  // namespace

Vector3d middleOf(const SplineSurface& surface, int index) {
  const SplineElement& element = surface.elements()[index];
  return surface
      .evaluate({index, (element.lower[0] + element.upper[0]) / 2,
                 (element.lower[1] + element.upper[1]) / 2})
      .position;
}

SplineBody::SplineBody(SplineSurface bodySurface, const Material& bodyMaterial,
                       const ExactField& exact, const AssemblyOptions& options, Precision precision,
                       const Job& job)
    : surface(std::move(bodySurface)), tractions(surface), material(bodyMaterial) {
  const TractionSlots& slots = tractions.slots;
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 1 &&
                                 !surface.barelyReaches(slot.node, slot.tag, slot.smoothingGroup)
                             ? SlotCondition::kFixed
                             : SlotCondition::kTraction);
  problem = makeDenseReferenceProblem(surface, tractions,
                                      {conditions, material, options, precision}, job, &times);
  BoundaryConditions given(surface.coefficientCount(), slots.count());
  given.ofSlot = conditions;
  given.displacement = projectDisplacement(
      surface, [&](const Vector3d& x, const Vector3d&) { return exact.displacement(x); });
  given.traction = projectTraction(
      surface, tractions, allElements(surface),
      [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
      INFINITY);
  const Bulk bulk{material, exact.bodyForce};
  Eigen::MatrixXd term;
  if (bulk.hasBodyForce())
    term = SplineResults(surface, tractions, job)
               .bodyForceTerm(splineEquations(surface, tractions, problem->dofs().extraSlots()),
                              bulk, job);
  field = problem->solveField(problem->dofs().knownField(given), ReferenceProblem::Effort::kRefined,
                              job, term);
}

Vector3d SplineBody::displacement(const ElementPlace& place) const {
  return sumAt(surface, place, field.u.col(0), surface.functions(place.element));
}

Vector3d SplineBody::traction(const ElementPlace& place) const {
  std::vector<double> basis;
  surface.evaluateTractionBasis(place, basis);
  return weightedSum(basis, tractions.ofFunction[place.element], field.p.col(0));
}

double SplineBody::displacementError(const ExactField& exact) const {
  return relativeError(
      surface, [&](const ElementPlace& place, const SurfaceJet&) { return displacement(place); },
      [&](const SurfaceJet& jet) { return exact.displacement(jet.position); });
}

double SplineBody::leastDisplacementError(const ExactField& exact) const {
  const Eigen::VectorXd nearest = projectDisplacement(
      surface, [&](const Vector3d& x, const Vector3d&) { return exact.displacement(x); });
  return relativeError(
      surface,
      [&](const ElementPlace& place, const SurfaceJet&) {
        return sumAt(surface, place, nearest, surface.functions(place.element));
      },
      [&](const SurfaceJet& jet) { return exact.displacement(jet.position); });
}

double SplineBody::tractionError(const ExactField& exact) const {
  return relativeError(
      surface, [&](const ElementPlace& place, const SurfaceJet&) { return traction(place); },
      [&](const SurfaceJet& jet) {
        return Vector3d(exact.stress(jet.position) * jet.areaVector().normalized());
      });
}

double SplineBody::area() const {
  double sum = 0;
  visitSplinePoints(surface, allElements(surface), 4, INFINITY,
                    [&](const ElementPlace&, const SurfaceJet&, double weight) { sum += weight; });
  return sum;
}

Vector3d SplineBody::reaction() const {
  Vector3d sum = Vector3d::Zero();
  visitSplinePoints(surface, allElements(surface), 4, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      if (surface.elements()[place.element].tag == 1)
                        sum += weight * traction(place);
                    });
  return sum;
}

ElementPlace nearestPlace(const SplineSurface& surface, const Vector3d& point) {
  ElementPlace best{0, 0, 0};
  double least = INFINITY;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplineElement& element = surface.elements()[e];
    std::array<double, 2> center, half;
    for (int d = 0; d < 2; ++d) {
      center[d] = (element.lower[d] + element.upper[d]) / 2;
      half[d] = (element.upper[d] - element.lower[d]) / 2;
    }
    for (int level = 0; level < 12; ++level) {
      std::array<double, 2> next = center;
      double found = INFINITY;
      for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) {
          const double u =
              std::clamp(center[0] + half[0] * i / 3, element.lower[0], element.upper[0]);
          const double v =
              std::clamp(center[1] + half[1] * j / 3, element.lower[1], element.upper[1]);
          const double distance = (surface.evaluate({e, u, v}).position - point).norm();
          if (distance >= found) continue;
          found = distance;
          next = {u, v};
        }
      center = next;
      for (double& size : half) size *= 0.5;
      if (found < least) {
        least = found;
        best = {e, next[0], next[1]};
      }
      if (level == 0 && found > 25) break;
    }
  }
  return best;
}

std::vector<int> allElements(const SplineSurface& surface) {
  std::vector<int> list;
  for (int e = 0; e < surface.elementCount(); ++e) list.push_back(e);
  return list;
}

bool isBelow(const Vector3d& x) {
  return x.z() < -std::max(std::abs(x.x()), std::abs(x.y()));
}

modeling::Solid makeTorus(double ring, double tube) {
  return modeling::makePrimitive({modeling::TorusShape{ring, tube}});
}

SplineSurface fixedWhere(SplineSurface surface,
                         const std::function<bool(const Vector3d&)>& isFixed) {
  for (int e = 0; e < surface.elementCount(); ++e)
    if (isFixed(middleOf(surface, e))) surface.setTag(e, 1);
  return surface;
}

modeling::Solid divided(const modeling::Solid& solid, int parts) {
  modeling::Solid fine = solid;
  std::set<std::pair<int, int>> done;
  for (int p = 0; p < static_cast<int>(solid.patches().size()); ++p)
    for (int d = 0; d < 2; ++d) {
      if (done.contains({p, d})) continue;
      for (const auto& link : modeling::chainOf(solid, {p, d}))
        done.insert({link.at.patch, link.at.direction});
      const std::vector<double>& knots = solid.patches()[p].knots[d];
      for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        for (int part = 1; part < parts && knots[k] < knots[k + 1]; ++part)
          fine = modeling::insertKnot(fine, {p, d},
                                      knots[k] + part * (knots[k + 1] - knots[k]) / parts);
    }
  return fine;
}

}  // namespace palpa::verification
