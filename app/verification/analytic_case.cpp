#include "app/verification/analytic_case.h"

#include <algorithm>
#include <stdexcept>

#include "app/verification/expression.h"
#include "modeling/error.h"

namespace palpa::verification {

using Eigen::Vector3d;
using nlohmann::json;

Vector3d vectorOf(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

AnalyticCase::AnalyticCase(const json& source)
    : json_(source),
      id_(source.at("id")),
      shape_(source.at("geometry").at("type")),
      material_{source.at("material").at("E"), source.at("material").at("nu")} {
  for (const auto& [name, number] : json_.at("params").items()) names_[name] = number;
  names_["E"] = material_.youngsModulus;
  names_["nu"] = material_.poissonRatio;
}

std::vector<AnalyticCase::Condition> AnalyticCase::conditions() const {
  std::vector<Condition> list;
  for (const json& bc : json_.at("bc"))
    list.push_back({bc.at("region"), bc.at("type"), bc.at("expr")});
  return list;
}

bool AnalyticCase::anyMixture() const {
  const auto list = conditions();
  return json_.contains("traction_expr") &&
         std::all_of(list.begin(), list.end(),
                     [](const Condition& condition) { return condition.type == "displacement"; });
}

bool AnalyticCase::isDetermined() const {
  const auto list = conditions();
  return material_.poissonRatio < 0.5 || list.size() != 1 || list[0].type != "displacement";
}

std::vector<AnalyticCase::Point> AnalyticCase::points() const {
  std::vector<Point> list;
  for (const json& point : json_.at("points"))
    list.push_back(
        {point.at("region") == "interior", vectorOf(point.at("x")), vectorOf(point.at("u"))});
  if (list.empty()) throw modeling::ModelingError(id_ + " has no points");
  return list;
}

double AnalyticCase::evaluated(const json& expression,
                               const std::map<std::string, double>& names) const {
  try {
    return evaluate(expression.get_ref<const std::string&>(), names);
  } catch (const std::invalid_argument& error) {
    throw modeling::ModelingError(id_ + ": " + error.what());
  }
}

Vector3d AnalyticCase::value(const json& expressions, const Vector3d& x, const Vector3d& n) const {
  std::map<std::string, double> names = names_;
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    names[axis] = x[i];
    names["n" + axis] = n[i];
  }
  return {evaluated(expressions.at("x"), names), evaluated(expressions.at("y"), names),
          evaluated(expressions.at("z"), names)};
}

ExactField AnalyticCase::exactField() const {
  const auto u = [this](const Vector3d& x) { return value(json_.at("u_expr"), x); };
  return {u,
          [this, u](const Vector3d& x) {
            const Eigen::Matrix3d gradient = differences(u, x, 0.05);
            if (material_.poissonRatio < 0.5) return hooke(gradient, material_);
            auto names = names_;
            for (int i = 0; i < 3; ++i) names[std::string(1, "xyz"[i])] = x[i];
            return Eigen::Matrix3d(material_.shear() * (gradient + gradient.transpose()) -
                                   evaluated(json_.at("pressure_expr"), names) *
                                       Eigen::Matrix3d::Identity());
          },
          bodyForce()};
}

Vector3d AnalyticCase::bodyForce() const {
  if (!json_.contains("body_force_expr")) return Vector3d::Zero();
  return value(json_.at("body_force_expr"), Vector3d::Zero());
}

double AnalyticCase::inconsistency() const {
  const ExactField exact = exactField();
  double difference = 0, scale = 0;
  for (const json& point : json_.at("points")) {
    const Vector3d x = vectorOf(point.at("x"));
    difference = worse(
        difference, (exact.displacement(x) - vectorOf(point.at("u"))).norm() * material_.shear());
    scale = std::max(scale, exact.stress(x).norm());
    if (!point.contains("t")) continue;
    const Vector3d n = vectorOf(point.at("n")), traction = exact.stress(x) * n;
    difference = worse(difference, (traction - vectorOf(point.at("t"))).norm());
    for (const Condition& condition : conditions())
      if (point.at("region") == condition.region && condition.type == "traction")
        difference = worse(difference, (traction - value(condition.expressions, x, n)).norm());
    if (json_.contains("traction_expr"))
      difference = worse(difference, (traction - value(json_.at("traction_expr"), x, n)).norm());
  }
  return difference / scale;
}

}  // namespace palpa::verification
