#include <algorithm>

#include "modeling/project/json_values.h"

namespace palpa::modeling {

using nlohmann::json;

Eigen::Vector3d vectorFrom(const json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

namespace {

RegionPart partFrom(const json& value) {
  if (value.contains("patches")) return PatchSet{value["patches"]};
  if (value.contains("stroke")) {
    const json& stroke = value["stroke"];
    Stroke result{{}, stroke["radius_mm"].get<double>()};
    for (const json& point : stroke["points_mm"]) result.points.push_back(vectorFrom(point));
    return result;
  }
  const json& half = value["half_space"];
  return HalfSpace{vectorFrom(half["normal"]), half["below_mm"].get<double>()};
}

}  // namespace

Material materialFrom(const json& value) {
  Material material;
  auto& [name, youngsModulus, poissonRatio, density] = material;  // the compiler counts the fields
  name = value.value("name", "");
  youngsModulus = value["youngs_modulus_MPa"];
  poissonRatio = value["poisson_ratio"];
  if (value.contains("density_kg_per_m3")) density = value["density_kg_per_m3"].get<double>();
  return material;
}

Region regionFrom(const json& value) {
  Region region;
  if (!value.is_array()) return {{partFrom(value)}};
  for (const json& part : value) {
    if (!part.contains("except")) {
      region.parts.push_back(partFrom(part));
      continue;
    }
    const std::vector<RegionPart> except = regionFrom(part["except"]).parts;
    region.except.insert(region.except.end(), except.begin(), except.end());
  }
  return region;
}

Support supportFrom(const json& value) {
  Support support;
  support.name = value["name"];
  support.kind = value["kind"] == "fixed" ? Support::Kind::kFixed : Support::Kind::kRoller;
  support.where = regionFrom(value["where"]);
  if (value.contains("displacement_mm"))
    support.displacement = vectorFrom(value["displacement_mm"]);
  return support;
}

Load loadFrom(const json& value) {
  const std::string name = value["name"];
  if (value["kind"] == "pressure")
    return {name, Pressure{regionFrom(value["where"]), value["MPa"].get<double>()}};
  if (value["kind"] == "traction")
    return {name, UniformTraction{regionFrom(value["where"]), vectorFrom(value["MPa"])}};
  if (value["kind"] == "force")
    return {name, TotalForce{regionFrom(value["where"]), vectorFrom(value["force_N"])}};
  if (value["kind"] == "moment")
    return {name, Moment{regionFrom(value["where"]), vectorFrom(value["moment_N_mm"])}};
  if (value["kind"] == "gravity") {
    Gravity gravity;
    if (value.contains("acceleration_m_per_s2"))
      gravity.accelerationMPerS2 = vectorFrom(value["acceleration_m_per_s2"]);
    return {name, gravity};
  }
  return {name, Bump{vectorFrom(value["center_mm"]), value["radius_mm"].get<double>(),
                     value["peak_MPa"].get<double>(), vectorFrom(value["direction"])}};
}

Touch touchFrom(const json& value) {
  Touch touch;
  touch.name = value["name"];
  touch.at = vectorFrom(value["at_mm"]);
  // Older files express a force as a grab with force_N.
  touch.kind = value.contains("force_N") ? TouchKind::kForce
                                         : *touchKindNamed(value["kind"].get<std::string>());
  if (const char* key = infoOf(touch.kind).vectorKey(); value.contains(key))
    touch.vector = vectorFrom(value[key]);
  if (value.contains("radius_mm")) touch.radius = value["radius_mm"].get<double>();
  touch.friction = value.value("friction", 0.0);
  return touch;
}

Measurement measurementFrom(const json& value) {
  Measurement measurement{
      value["name"], *measurementKindNamed(value["kind"].get<std::string>()), {}};
  for (const json& one : value["places"]) {
    MeasuredPlace& place = measurement.places.emplace_back();
    const auto what = std::find(kMeasuredWhatNames.begin(), kMeasuredWhatNames.end(), one["what"]);
    place.what = static_cast<MeasuredPlace::What>(what - kMeasuredWhatNames.begin());
    place.patch = one["patch"];
    if (one.contains("uv"))
      place.at = Eigen::Vector2d(one["uv"][0].get<double>(), one["uv"][1].get<double>());
    else
      place.at = vectorFrom(one["at_mm"]);
    if (one.contains("side")) place.side = sideFrom(one["side"]);
    place.other = one.value("other", "");
  }
  return measurement;
}

MeshSettings meshFrom(const json& value) {
  MeshSettings settings;
  settings.edgeLength = value["edge_length_mm"];
  if (value.contains("patch_factors"))
    settings.patchFactors = value["patch_factors"].get<std::map<std::string, double>>();
  const std::string engine = value.value("engine", "automatic");
  if (engine != "automatic")
    settings.engine = engine == "splines"     ? Engine::kSplines
                      : engine == "quadratic" ? Engine::kQuadratic
                                              : Engine::kTriangles;
  settings.accuracy = value.value("accuracy", settings.accuracy);
  settings.splineDensity = value.value("spline_density", settings.splineDensity);
  settings.featureFraction = value.value("feature_fraction", settings.featureFraction);
  if (value.contains("element_length_mm"))
    settings.elementLength = value["element_length_mm"].get<double>();
  if (!value.contains("refinement")) return settings;
  settings.refinementLevels = value["refinement"]["levels"];
  for (const json& at : value["refinement"]["at"])
    (at == "sharp_edges" ? settings.refineAtSharpEdges : settings.refineAtBorders) = true;
  return settings;
}

}  // namespace palpa::modeling
