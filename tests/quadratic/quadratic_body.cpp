#include "quadratic_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bem/dense/update_reference_problem.h"
#include "bem/quadratic/quartered_mesh.h"

namespace palpa::bem::test {

using Eigen::Vector3d;
using Eigen::VectorXd;

PlaceMiddle onSphere(double radius) {
  return [radius](const Vector3d& a, const Vector3d& b, double share) {
    return Vector3d(radius * onFlatFaces(a, b, share).normalized());
  };
}

PlaceMiddle onCylinder(double radius) {
  return [radius](const Vector3d& a, const Vector3d& b, double share) {
    Vector3d middle = onFlatFaces(a, b, share);
    const auto isOnSide = [radius](const Vector3d& x) {
      return x.head<2>().norm() > (1 - 1e-9) * radius;
    };
    if (isOnSide(a) && isOnSide(b)) middle.head<2>() *= radius / middle.head<2>().norm();
    return middle;
  };
}

std::unique_ptr<QuadraticDiscretisation> quadratic(const BoundaryMesh& corners,
                                                   const PlaceMiddle& middle,
                                                   const std::vector<int>& supportTags) {
  const auto placed = [&](int t, int k, double share) {
    const auto& nodes = corners.triangles[t];
    return middle(corners.nodes[nodes[k]], corners.nodes[nodes[(k + 1) % 3]], share);
  };
  return std::make_unique<QuadraticDiscretisation>(quarteredMesh(corners, placed, supportTags),
                                                   supportTags);
}

QuadraticBody::QuadraticBody(std::unique_ptr<QuadraticDiscretisation> discretisation,
                             const Material& bodyMaterial, const ExactField& exact,
                             const std::function<SlotCondition(int tag)>& conditionOfTag,
                             const AssemblyOptions& options)
    : on(std::move(discretisation)), material(bodyMaterial) {
  for (const auto& slot : on->slots().slots) conditions.push_back(conditionOfTag(slot.tag));
  problem = makeDenseReferenceProblem(*on, {conditions, material, options, Precision::kDouble}, {},
                                      &times);
  BoundaryConditions data(on->displacementCount(), on->slots().count());
  data.ofSlot = conditions;
  for (int k = 0; k < on->displacementCount(); ++k)
    data.displacement.segment<3>(3 * k) = exact.displacement(on->places()[k]);
  std::vector<int> all(static_cast<std::size_t>(on->elementCount()));
  std::iota(all.begin(), all.end(), 0);
  data.traction = on->integrals().projectTraction(
      all, [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
      std::numeric_limits<double>::infinity());
  VectorXd term;
  if (!exact.bodyForce.isZero(0))
    term = on->bodyForceTerm(problem->dofs(), {material, exact.bodyForce}, Job{});
  field = problem->solveField(problem->dofs().knownField(data), ReferenceProblem::Effort::kRefined,
                              Job{}, term);
}

double QuadraticBody::displacementError(const ExactField& exact) const {
  double error = 0, size = 0;
  std::vector<double> basis;
  const VectorXd u = field.u.col(0);
  for (int e = 0; e < on->elementCount(); ++e)
    on->surface().visitPoints(
        e, 1, [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
          on->surface().evaluateBasis(place, basis);
          const Vector3d expected = exact.displacement(jet.position);
          error += weight *
                   (weightedSum(basis, on->surface().coefficients(e), u) - expected).squaredNorm();
          size += weight * expected.squaredNorm();
        });
  return std::sqrt(error / size);
}

double QuadraticBody::maxTractionError(const ExactField& exact) const {
  double error = 0, size = 0;
  for (int e = 0; e < on->elementCount(); ++e)
    for (int f = 0; f < 6; ++f) {
      const ElementPlace place = on->surface().placeOf(on->surface().coefficients(e)[f], e);
      const SurfaceJet jet = on->surface().evaluate(place);
      const Vector3d expected = exact.stress(jet.position) * jet.areaVector().normalized();
      error = std::max(
          error, (field.p.col(0).segment<3>(3 * on->surface().slots(e)[f]) - expected).norm());
      size = std::max(size, expected.norm());
    }
  return error / size;
}

double updateError(const QuadraticDiscretisation& before, const QuadraticDiscretisation& after,
                   const ProblemInputs& inputs) {
  const std::shared_ptr<const ReferenceProblem> base = makeDenseReferenceProblem(before, inputs);
  const auto updated = updateDenseReferenceProblem(base, before, after, inputs);
  if (!updated) return std::numeric_limits<double>::infinity();
  const auto rebuilt = makeDenseReferenceProblem(after, inputs);
  const DegreesOfFreedom& dofs = rebuilt->dofs();
  Eigen::VectorXd known = Eigen::VectorXd::Zero(dofs.nodalCount());
  for (Eigen::Index k = 0; k < known.size(); ++k)
    known[k] = dofs.isFree(static_cast<int>(k / 3)) ? std::sin(0.37 * static_cast<double>(k)) : 0;
  const BoundaryField field = dofs.expand(Eigen::VectorXd::Zero(dofs.count()), known);
  const auto solve = [&](const ReferenceProblem& problem) {
    return problem.solveField(field, ReferenceProblem::Effort::kRefined, Job{});
  };
  const BoundaryField a = solve(*updated), b = solve(*rebuilt);
  return (a.u - b.u).norm() / b.u.norm();
}

}  // namespace palpa::bem::test
