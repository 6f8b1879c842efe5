#include "modeling/project/json_values.h"

namespace palpa::modeling {

Json jsonOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

namespace {

Json partOf(const RegionPart& part) {
  if (const auto* half = std::get_if<HalfSpace>(&part))
    return {{"half_space", {{"normal", jsonOf(half->normal)}, {"below_mm", half->below}}}};
  if (const auto* stroke = std::get_if<Stroke>(&part))
    return {{"stroke", {{"points_mm", jsonOfEach(stroke->points)}, {"radius_mm", stroke->radius}}}};
  return {{"patches", std::get<PatchSet>(part).patches}};
}

}  // namespace

Json jsonOf(const Region& region) {
  if (region.parts.size() == 1 && region.except.empty()) return partOf(region.parts.front());
  Json parts = Json::array(), except = Json::array();
  for (const RegionPart& part : region.parts) parts.push_back(partOf(part));
  for (const RegionPart& part : region.except) except.push_back(partOf(part));
  if (!except.empty()) parts.push_back({{"except", std::move(except)}});
  return parts;
}

Json jsonOf(const Support& support) {
  Json object{{"name", support.name},
              {"kind", support.kind == Support::Kind::kFixed ? "fixed" : "roller"},
              {"where", jsonOf(support.where)}};
  if (support.displacement != Eigen::Vector3d::Zero())
    object["displacement_mm"] = jsonOf(support.displacement);
  return object;
}

namespace {

void add(Json& object, const Pressure& load) {
  object["kind"] = "pressure";
  object["where"] = jsonOf(load.where);
  object["MPa"] = load.pressure;
}

void add(Json& object, const UniformTraction& load) {
  object["kind"] = "traction";
  object["where"] = jsonOf(load.where);
  object["MPa"] = jsonOf(load.traction);
}

void add(Json& object, const TotalForce& load) {
  object["kind"] = "force";
  object["where"] = jsonOf(load.where);
  object["force_N"] = jsonOf(load.force);
}

void add(Json& object, const Moment& load) {
  object["kind"] = "moment";
  object["where"] = jsonOf(load.where);
  object["moment_N_mm"] = jsonOf(load.moment);
}

void add(Json& object, const Gravity& load) {
  object["kind"] = "gravity";
  if (load != Gravity{}) object["acceleration_m_per_s2"] = jsonOf(load.accelerationMPerS2);
}

void add(Json& object, const Bump& load) {
  object["kind"] = "bump";
  object["center_mm"] = jsonOf(load.center);
  object["radius_mm"] = load.radius;
  object["peak_MPa"] = load.peak;
  object["direction"] = jsonOf(load.direction);
}

}  // namespace

Json jsonOf(const Load& load) {
  Json object{{"name", load.name}};
  std::visit([&](const auto& what) { add(object, what); }, load.what);
  return object;
}

Json jsonOf(const Touch& touch) {
  const TouchKindInfo& kind = infoOf(touch.kind);
  Json object{{"name", touch.name}, {"kind", kind.name}, {"at_mm", jsonOf(touch.at)}};
  if (kind.needsVector || touch.vector != Eigen::Vector3d::Zero())
    object[kind.vectorKey()] = jsonOf(touch.vector);
  if (touch.radius) object["radius_mm"] = *touch.radius;
  if (kind.presses && touch.friction != 0.0) object["friction"] = touch.friction;
  return object;
}

Json jsonOf(const Measurement& measurement) {
  Json places = Json::array();
  for (const MeasuredPlace& place : measurement.places) {
    Json& one =
        places.emplace_back(Json{{"what", kMeasuredWhatNames[static_cast<std::size_t>(place.what)]},
                                 {"patch", place.patch}});
    if (place.side) one["side"] = sideKey(*place.side);
    if (!place.other.empty()) one["other"] = place.other;
    if (const auto* uv = std::get_if<Eigen::Vector2d>(&place.at))
      one["uv"] = {uv->x(), uv->y()};
    else
      one["at_mm"] = jsonOf(std::get<Eigen::Vector3d>(place.at));
  }
  return {{"name", measurement.name},
          {"kind", infoOf(measurement.kind).name},
          {"places", std::move(places)}};
}

Json jsonOf(const MeshSettings& mesh) {
  Json object{{"edge_length_mm", mesh.edgeLength}};
  if (!mesh.patchFactors.empty()) object["patch_factors"] = mesh.patchFactors;
  if (mesh.engine != Engine::kAutomatic)
    object["engine"] = mesh.engine == Engine::kSplines     ? "splines"
                       : mesh.engine == Engine::kQuadratic ? "quadratic"
                                                           : "triangles";
  if (mesh.accuracy != MeshSettings{}.accuracy) object["accuracy"] = mesh.accuracy;
  if (mesh.splineDensity != MeshSettings{}.splineDensity)
    object["spline_density"] = mesh.splineDensity;
  if (mesh.featureFraction != MeshSettings{}.featureFraction)
    object["feature_fraction"] = mesh.featureFraction;
  if (mesh.elementLength) object["element_length_mm"] = *mesh.elementLength;
  if (mesh.refinementLevels > 0 || mesh.refineAtSharpEdges || mesh.refineAtBorders) {
    Json at = Json::array();
    if (mesh.refineAtSharpEdges) at.push_back("sharp_edges");
    if (mesh.refineAtBorders) at.push_back("support_borders");
    object["refinement"] = {{"levels", mesh.refinementLevels}, {"at", std::move(at)}};
  }
  return object;
}

Json jsonOf(const Material& material) {
  const auto& [name, youngsModulus, poissonRatio, density] = material;
  Json object{
      {"name", name}, {"youngs_modulus_MPa", youngsModulus}, {"poisson_ratio", poissonRatio}};
  if (density) object["density_kg_per_m3"] = *density;
  return object;
}

}  // namespace palpa::modeling
