#include "app/verification/analytic_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/model/traction_projection.h"
#include "bem/triangle/results.h"
#include "bem/triangle/triangle_body_force.h"
#include "modeling/error.h"

namespace palpa::verification {
using namespace bem;

namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Tag of the part where the exact displacement is prescribed besides the stated conditions.
constexpr int kHeld = 10;

BoundaryMesh makeMesh(const AnalyticCase& body) {
  const json& g = body.geometry();
  const std::string& shape = body.shape();
  if (shape == "sphere") return sphereMesh(g.at("R"), 9);
  if (shape == "hollow_sphere") {
    const double inner = g.at("a_inner"), outer = g.at("b_outer");
    return retagged(hollowSphereMesh(inner, outer, 5, 8), 1,
                    [=](const Vector3d& x) { return x.norm() < (inner + outer) / 2; });
  }
  if (shape == "cylinder") return cylinderMesh(g.at("R"), g.at("H"), 28, 14);
  if (shape == "hollow_cylinder")
    return hollowCylinderMesh(g.at("a_inner"), g.at("b_outer"), g.at("H"), 32, 7);
  if (shape == "box") return boxMesh(vectorOf(g.at("min")), vectorOf(g.at("max")), 12, 9, 6);
  if (shape == "torus") return torusMesh(g.at("R_major"), g.at("r_minor"), 40, 14);
  throw modeling::ModelingError(body.id() + ": there is no mesh of a " + shape);
}

/// By tag.
std::vector<std::string> regionsOf(const std::string& shape) {
  if (shape == "hollow_sphere") return {"outer", "inner"};
  if (shape == "cylinder") return {"side", "bottom", "top"};
  if (shape == "hollow_cylinder") return {"outer", "bottom", "top", "inner"};
  if (shape == "box") return {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  return {"outer"};
}

struct Part {
  SlotCondition condition = SlotCondition::kTraction;
  json expressions;  ///< of what is given
};

/// The mesh of a case, and what is given on it by tag.
std::pair<BoundaryMesh, std::vector<Part>> pose(const AnalyticCase& body, BoundaryData data) {
  std::vector<Part> parts(kHeld + 1);
  const auto names = regionsOf(body.shape());
  for (std::size_t tag = 0; tag < names.size(); ++tag)
    for (const AnalyticCase::Condition& given : body.conditions()) {
      if (given.region != names[tag] && given.region != "all") continue;
      parts[tag] = {given.type == "displacement" ? SlotCondition::kFixed
                    : given.type == "mixed"      ? SlotCondition::kRoller
                                                 : SlotCondition::kTraction,
                    given.expressions};
    }
  parts[kHeld] = {SlotCondition::kFixed, body.source().at("u_expr")};
  if (data == BoundaryData::kMixed)
    for (std::size_t tag = 0; tag < names.size(); ++tag)
      parts[tag] = {SlotCondition::kTraction, body.source().at("traction_expr")};

  BoundaryMesh mesh = makeMesh(body);
  const bool held = std::any_of(parts.begin(), parts.begin() + kHeld, [](const Part& part) {
    return part.condition == SlotCondition::kFixed;
  });
  if (held) return {mesh, parts};
  const std::string& shape = body.shape();
  if (shape == "hollow_cylinder" || (shape == "cylinder" && data == BoundaryData::kAsStated)) {
    // Only the translations along x and y and the rotation about z are free.
    const double height = body.geometry().at("H");
    return {retagged(mesh, kHeld,
                     [=](const Vector3d& x) {
                       return x[0] > 14 && std::abs(x[2] - height / 2) < height / 6;
                     }),
            parts};
  }
  const double cut = shape == "torus"                                ? -4
                     : shape == "sphere" || shape == "hollow_sphere" ? -18
                                                                     : 1e-6;
  return {retagged(mesh, kHeld, [=](const Vector3d& x) { return x[2] < cut; }), parts};
}

/// A solution on its mesh.
struct Solution {
  const AnalyticCase& body;
  const BoundaryMesh& mesh;
  const TractionSlots& slots;
  const BoundaryField& field;

  /// `leastScale`: mm, of the displacements.
  double pointError(double leastScale) const {
    double error = 0, scale = leastScale;
    for (const AnalyticCase::Point& point : body.points()) {
      Vector3d found = Vector3d::Constant(kInfinity);
      if (!point.isInside) {
        found = surfaceDisplacement(mesh, slots, field.u.col(0), field.p.col(0), body.bulk(),
                                    nearestSurfacePoint(mesh, point.at));
      } else if (const auto state = interiorState(mesh, slots, field.u.col(0), field.p.col(0),
                                                  body.bulk(), point.at)) {
        found = state->displacement;
      }
      error = worse(error, (found - point.displacement).norm());
      scale = std::max(scale, point.displacement.norm());
    }
    return error / scale;
  }

  double resultantError() const {
    if (!body.source().contains("resultants")) return 0;
    const double height = body.geometry().at("H");
    const Resultant found =
        tractionResultant(mesh, slots, field.p.col(0), trianglesWithTag(mesh, 1));
    double force = 0, moment = 0, forceError = 0, momentError = 0;
    for (const auto& [name, numbers] : body.source().at("resultants").items()) {
      if (name == "reaction_force_on_bottom") {
        force = vectorOf(numbers).norm();
        forceError = (found.force - vectorOf(numbers)).norm();
      } else if (name.starts_with("reaction_moment_on_bottom")) {
        moment = vectorOf(numbers).norm();
        momentError = (found.moment - vectorOf(numbers)).norm();
      }
    }
    // A pure moment has the force of itself over the height for its scale.
    const double scale = std::max(force, moment / height);
    return worse(forceError, momentError / height) / scale;
  }
};

}  // namespace

TriangleErrors solveWithTriangles(const AnalyticCase& body, BoundaryData data, const Job& job) {
  const auto [mesh, parts] = pose(body, data);
  const TractionSlots slots(mesh);
  BoundaryConditions given(mesh, slots);
  for (int s = 0; s < slots.count(); ++s) {
    const auto& slot = slots.slots[s];
    const Part& part = parts[slot.tag];
    given.ofSlot[s] = part.condition;
    if (part.condition != SlotCondition::kTraction)
      given.displacement.segment<3>(3 * slot.node) =
          body.value(part.expressions, mesh.nodes[slot.node]);
  }
  for (std::size_t tag = 0; tag < parts.size(); ++tag)
    if (!parts[tag].expressions.is_null() && parts[tag].condition != SlotCondition::kFixed)
      given.traction +=
          projectTraction(mesh, slots,
                          {trianglesWithTag(mesh, static_cast<int>(tag)),
                           [&body, &part = parts[tag]](const Vector3d& x, const Vector3d& n) {
                             return body.value(part.expressions, x, n);
                           },
                           kInfinity});
  const auto problem = makeDenseReferenceProblem(
      mesh, slots, {given.ofSlot, body.material(), {}, Precision::kDouble}, job);
  Eigen::MatrixXd term;
  if (const Bulk bulk = body.bulk(); bulk.hasBodyForce())
    term = TriangleBodyForce(mesh).term(problem->dofs().collocationPoints(mesh, slots), bulk, job);
  const BoundaryField field = problem->solveField(problem->dofs().knownField(given),
                                                  ReferenceProblem::Effort::kRefined, job, term);

  const ExactField exact = body.exactField();
  double error = 0, scale = 0, tractionError = 0, tractionScale = 0;
  int unknown = 0;
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    const Vector3d expected = exact.displacement(mesh.nodes[k]);
    error += (field.u.col(0).segment<3>(3 * k) - expected).squaredNorm();
    scale += expected.squaredNorm();
  }
  for (int s = 0; s < slots.count(); ++s) {
    const auto& slot = slots.slots[s];
    const Vector3d expected = exact.stress(mesh.nodes[slot.node]) * slot.normal;
    tractionScale += expected.squaredNorm() / slots.count();
    if (given.ofSlot[s] != SlotCondition::kFixed) continue;
    ++unknown;
    tractionError += (field.p.col(0).segment<3>(3 * s) - expected).squaredNorm();
  }
  // A body under pressure that is incompressible does not move at all: its error is compared with a
  // twentieth of what the load would do to a rod of its size.
  const double least =
      0.05 * std::sqrt(tractionScale) / body.material().youngsModulus * mesh.boundingSize();
  scale = std::max(scale, mesh.nodeCount() * least * least);
  const Solution solution{body, mesh, slots, field};
  return {mesh.nodeCount(), std::sqrt(error / scale), solution.pointError(least),
          std::sqrt(tractionError / std::max(unknown, 1) / tractionScale),
          solution.resultantError()};
}

}  // namespace palpa::verification
