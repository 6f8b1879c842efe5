#include "analytic_case.h"

#include <algorithm>
#include <limits>

#include "bem/results.h"
#include "expression.h"
#include "test_meshes.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Tag of the part where the exact displacement is prescribed besides the stated conditions.
constexpr int kHeld = 10;

Vector3d vectorOf(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

}  // namespace

AnalyticCase::AnalyticCase(const json& source)
    : json_(source),
      type_(source["geometry"]["type"]),
      material_{source["material"]["E"], source["material"]["nu"]} {
  for (const auto& [name, number] : json_["params"].items()) names_[name] = number;
  names_["E"] = material_.youngsModulus;
  names_["nu"] = material_.poissonRatio;
}

bool AnalyticCase::hasBody(const json& source) {
  const std::string type = source["geometry"]["type"];
  return type != "halfspace" && type != "contact";
}

bool AnalyticCase::anyMixture() const {
  return json_.contains("traction_expr") && material_.poissonRatio < 0.5 &&
         std::all_of(json_["bc"].begin(), json_["bc"].end(),
                     [](const json& bc) { return bc["type"] == "displacement"; });
}

Vector3d AnalyticCase::value(const json& expressions, const Vector3d& x, const Vector3d& n) const {
  std::map<std::string, double> names = names_;
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    names[axis] = x[i];
    names["n" + axis] = n[i];
  }
  return {evaluate(expressions["x"], names), evaluate(expressions["y"], names),
          evaluate(expressions["z"], names)};
}

ExactField AnalyticCase::exactField() const {
  const auto u = [this](const Vector3d& x) { return value(json_["u_expr"], x); };
  return {u, [this, u](const Vector3d& x) {
            const Eigen::Matrix3d gradient = differences(u, x, 0.05);
            if (material_.poissonRatio < 0.5) return hooke(gradient, material_);
            auto names = names_;
            for (int i = 0; i < 3; ++i) names[std::string(1, "xyz"[i])] = x[i];
            return Eigen::Matrix3d(material_.shear() * (gradient + gradient.transpose()) -
                                   evaluate(json_["pressure_expr"], names) *
                                       Eigen::Matrix3d::Identity());
          }};
}

double AnalyticCase::inconsistency() const {
  const ExactField exact = exactField();
  double difference = 0, scale = 0;
  for (const json& point : json_["points"]) {
    const Vector3d x = vectorOf(point["x"]);
    difference = std::max(
        difference, (exact.displacement(x) - vectorOf(point["u"])).norm() * material_.shear());
    scale = std::max(scale, exact.stress(x).norm());
    if (!point.contains("t")) continue;
    const Vector3d n = vectorOf(point["n"]), traction = exact.stress(x) * n;
    difference = std::max(difference, (traction - vectorOf(point["t"])).norm());
    for (const json& bc : json_["bc"])
      if (bc["region"] == point["region"] && bc["type"] == "traction")
        difference = std::max(difference, (traction - value(bc["expr"], x, n)).norm());
    if (json_.contains("traction_expr"))
      difference = std::max(difference, (traction - value(json_["traction_expr"], x, n)).norm());
  }
  return difference / scale;
}

// About 500 nodes each, so elements of 4 to 5 mm.
BoundaryMesh AnalyticCase::makeMesh() const {
  const json& g = json_["geometry"];
  if (type_ == "sphere") return sphereMesh(g["R"], 9);
  if (type_ == "hollow_sphere") {
    const double inner = g["a_inner"], outer = g["b_outer"];
    return retagged(hollowSphereMesh(inner, outer, 5, 8), 1,
                    [=](const Vector3d& x) { return x.norm() < (inner + outer) / 2; });
  }
  if (type_ == "cylinder") return cylinderMesh(g["R"], g["H"], 28, 14);
  if (type_ == "hollow_cylinder")
    return hollowCylinderMesh(g["a_inner"], g["b_outer"], g["H"], 32, 7);
  if (type_ == "box") return boxMesh(vectorOf(g["min"]), vectorOf(g["max"]), 12, 9, 6);
  return torusMesh(g["R_major"], g["r_minor"], 40, 14);
}

std::vector<std::string> AnalyticCase::regions() const {
  if (type_ == "hollow_sphere") return {"outer", "inner"};
  if (type_ == "cylinder") return {"side", "bottom", "top"};
  if (type_ == "hollow_cylinder") return {"outer", "bottom", "top", "inner"};
  if (type_ == "box") return {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  return {"outer"};
}

std::pair<BoundaryMesh, std::vector<AnalyticCase::Part>> AnalyticCase::pose(Data data) const {
  std::vector<Part> parts(kHeld + 1);
  const auto names = regions();
  for (std::size_t tag = 0; tag < names.size(); ++tag)
    for (const json& bc : json_["bc"]) {
      if (bc["region"] != names[tag] && bc["region"] != "all") continue;
      const SlotCondition condition = bc["type"] == "displacement" ? SlotCondition::kFixed
                                      : bc["type"] == "mixed"      ? SlotCondition::kRoller
                                                                   : SlotCondition::kTraction;
      parts[tag] = {names[tag], condition, bc["expr"]};
    }
  parts[kHeld] = {"held", SlotCondition::kFixed, json_["u_expr"]};
  if (data == Data::kMixed)
    for (std::size_t tag = 0; tag < names.size(); ++tag)
      parts[tag] = {names[tag], SlotCondition::kTraction, json_["traction_expr"]};

  BoundaryMesh mesh = makeMesh();
  const bool held = std::any_of(parts.begin(), parts.begin() + kHeld, [](const Part& part) {
    return part.condition == SlotCondition::kFixed;
  });
  if (held) return {mesh, parts};
  if (type_ == "hollow_cylinder" || (type_ == "cylinder" && data == Data::kAsStated)) {
    // Only the translations along x and y and the rotation about z are free.
    const double height = json_["geometry"]["H"];
    return {retagged(mesh, kHeld,
                     [=](const Vector3d& x) {
                       return x[0] > 14 && std::abs(x[2] - height / 2) < height / 6;
                     }),
            parts};
  }
  const double cut = type_ == "torus"                                ? -4
                     : type_ == "sphere" || type_ == "hollow_sphere" ? -18
                                                                     : 1e-6;
  return {retagged(mesh, kHeld, [=](const Vector3d& x) { return x[2] < cut; }), parts};
}

double AnalyticCase::pointError(const BoundaryMesh& mesh, const TractionSlots& slots,
                                const BoundaryField& field, double leastScale) const {
  double error = 0, scale = leastScale;
  for (const json& point : json_["points"]) {
    const Vector3d x = vectorOf(point["x"]), expected = vectorOf(point["u"]);
    Vector3d found = Vector3d::Constant(kInfinity);
    if (point["region"] == "interior") {
      const auto state = interiorState(mesh, slots, field.u.col(0), field.p.col(0), material_, x);
      if (state) found = state->displacement;
    } else {
      found = surfaceDisplacement(mesh, slots, field.u.col(0), field.p.col(0), material_,
                                  nearestSurfacePoint(mesh, x));
    }
    error = std::max(error, (found - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  return error / scale;
}

double AnalyticCase::resultantError(const BoundaryMesh& mesh, const TractionSlots& slots,
                                    const BoundaryField& field) const {
  if (!json_.contains("resultants")) return 0;
  const json& given = json_["resultants"];
  const double height = json_["geometry"]["H"];
  const Resultant found = tractionResultant(mesh, slots, field.p.col(0), trianglesWithTag(mesh, 1));
  double force = 0, moment = 0, forceError = 0, momentError = 0;
  for (const auto& [name, numbers] : given.items()) {
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
  return std::max(forceError, momentError / height) / scale;
}

AnalyticCase::Errors AnalyticCase::solve(Data data) const {
  const auto [mesh, parts] = pose(data);
  const TractionSlots slots(mesh);
  BoundaryConditions given(mesh, slots);
  for (int s = 0; s < slots.count(); ++s) {
    const auto& slot = slots.slots[s];
    const Part& part = parts[slot.tag];
    given.ofSlot[s] = part.condition;
    if (part.condition != SlotCondition::kTraction)
      given.displacement.segment<3>(3 * slot.node) = value(part.data, mesh.nodes[slot.node]);
  }
  for (std::size_t tag = 0; tag < parts.size(); ++tag)
    if (!parts[tag].data.is_null() && parts[tag].condition != SlotCondition::kFixed)
      given.traction +=
          projectTraction(mesh, slots,
                          {trianglesWithTag(mesh, static_cast<int>(tag)),
                           [this, &part = parts[tag]](const Vector3d& x, const Vector3d& n) {
                             return value(part.data, x, n);
                           },
                           kInfinity});
  const auto problem = makeDenseReferenceProblem(mesh, slots, given.ofSlot, material_, {},
                                                 Precision::kDouble, Job{});
  const BoundaryField field = problem->solveField(problem->dofs().knownField(given));

  const ExactField exact = exactField();
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
      0.05 * std::sqrt(tractionScale) / material_.youngsModulus * mesh.boundingSize();
  scale = std::max(scale, mesh.nodeCount() * least * least);
  return {mesh.nodeCount(), std::sqrt(error / scale), pointError(mesh, slots, field, least),
          std::sqrt(tractionError / std::max(unknown, 1) / tractionScale),
          resultantError(mesh, slots, field)};
}

}  // namespace palpa::bem::test
