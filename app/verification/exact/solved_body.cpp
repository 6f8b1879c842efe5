#include "app/verification/exact/solved_body.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "bem/dense/make_reference_problem.h"
#include "bem/model/traction_projection.h"
#include "bem/triangle/triangle_body_force.h"

namespace palpa::verification {
using namespace bem;
using Eigen::Vector3d;

BoundaryMesh retagged(BoundaryMesh mesh, int tag,
                      const std::function<bool(const Vector3d&)>& inside) {
  for (int t = 0; t < mesh.triangleCount(); ++t)
    if (inside(mesh.point(t, Vector3d::Constant(1.0 / 3)))) mesh.tags[t] = tag;
  return mesh;
}

std::vector<int> allTriangles(const BoundaryMesh& mesh) {
  std::vector<int> list(mesh.triangles.size());
  std::iota(list.begin(), list.end(), 0);
  return list;
}

std::vector<int> trianglesWithTag(const BoundaryMesh& mesh, int tag) {
  std::vector<int> list;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    if (mesh.tags[t] == tag) list.push_back(t);
  return list;
}

SolvedBody::SolvedBody(BoundaryMesh bodyMesh, const Material& bodyMaterial, const ExactField& exact,
                       const ConditionOfTag& conditionOfTag, const Options& options)
    : mesh(std::move(bodyMesh)), slots(mesh), material(bodyMaterial) {
  mesh.validate();
  for (const auto& slot : slots.slots) conditions.push_back(conditionOfTag(slot.tag));
  BoundaryConditions given(mesh, slots);
  given.ofSlot = conditions;
  for (int k = 0; k < mesh.nodeCount(); ++k)
    given.displacement.segment<3>(3 * k) = exact.displacement(mesh.nodes[k]);
  given.traction = projectTraction(
      mesh, slots,
      {allTriangles(mesh),
       [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
       std::numeric_limits<double>::infinity()});
  problem = makeDenseReferenceProblem(mesh, slots,
                                      {conditions, material, options.assembly, options.precision},
                                      options.job, &times);
  const Bulk bulk{material, exact.bodyForce};
  Eigen::MatrixXd term;
  if (bulk.hasBodyForce())
    term = TriangleBodyForce(mesh).term(problem->dofs().collocationPoints(mesh, slots), bulk,
                                        options.job);
  field = problem->solveField(problem->dofs().knownField(given), ReferenceProblem::Effort::kRefined,
                              options.job, term);
}

double SolvedBody::displacementError(const ExactField& exact) const {
  double error = 0, scale = 0;
  visitQuadraturePoints(mesh, allTriangles(mesh), std::numeric_limits<double>::infinity(),
                        [&](int t, const Vector3d& weights, double weight) {
                          Vector3d found = Vector3d::Zero();
                          for (int k = 0; k < 3; ++k)
                            found +=
                                weights[k] * field.u.col(0).segment<3>(3 * mesh.triangles[t][k]);
                          const Vector3d expected = exact.displacement(mesh.point(t, weights));
                          error += weight * (found - expected).squaredNorm();
                          scale += weight * expected.squaredNorm();
                        });
  return std::sqrt(error / scale);
}

double SolvedBody::maxDisplacementError(const ExactField& exact) const {
  double error = 0, scale = 0;
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    const Vector3d expected = exact.displacement(mesh.nodes[k]);
    error = std::max(error, (field.u.col(0).segment<3>(3 * k) - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  return error / scale;
}

double SolvedBody::rmsDisplacementError(const ExactField& exact) const {
  double error = 0, scale = 0;
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    const Vector3d expected = exact.displacement(mesh.nodes[k]);
    error += (field.u.col(0).segment<3>(3 * k) - expected).squaredNorm();
    scale += expected.squaredNorm();
  }
  return std::sqrt(error / scale);
}

double SolvedBody::maxTractionError(const ExactField& exact) const {
  double error = 0, scale = 0;
  for (int s = 0; s < slots.count(); ++s) {
    const Vector3d expected = exact.stress(mesh.nodes[slots.slots[s].node]) * slots.slots[s].normal;
    error = std::max(error, (field.p.col(0).segment<3>(3 * s) - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  return error / scale;
}

double observedOrder(double coarseError, int coarseNodes, double fineError, int fineNodes) {
  return 2 * std::log(coarseError / fineError) /
         std::log(static_cast<double>(fineNodes) / coarseNodes);
}

}  // namespace palpa::verification
