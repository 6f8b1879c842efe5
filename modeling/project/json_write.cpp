#include "base/text.h"
#include "modeling/project/json_values.h"

namespace palpa::modeling {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string vectorText(const Eigen::Vector3d& v) {
  return "[" + numberText(v.x()) + ", " + numberText(v.y()) + ", " + numberText(v.z()) + "]";
}

std::string linesText(const std::vector<std::string>& lines, const std::string& indent) {
  if (lines.empty()) return "[]";
  std::string result = "[\n";
  for (std::size_t i = 0; i < lines.size(); ++i)
    result += indent + "  " + lines[i] + (i + 1 < lines.size() ? ",\n" : "\n");
  return result + indent + "]";
}

namespace {

std::string partText(const RegionPart& part) {
  if (const auto* half = std::get_if<HalfSpace>(&part))
    return "{\"half_space\": {\"normal\": " + vectorText(half->normal) +
           ", \"below_mm\": " + numberText(half->below) + "}}";
  if (const auto* stroke = std::get_if<Stroke>(&part))
    return "{\"stroke\": {\"points_mm\": " + listText(stroke->points, vectorText) +
           ", \"radius_mm\": " + numberText(stroke->radius) + "}}";
  return "{\"patches\": " + listText(std::get<PatchSet>(part).patches, quoted) + "}";
}

}  // namespace

std::string regionText(const Region& region) {
  return region.parts.size() == 1 ? partText(region.parts.front())
                                  : listText(region.parts, partText);
}

std::string supportText(const Support& support) {
  std::string text = "{\"name\": " + quoted(support.name) + ", \"kind\": " +
                     (support.kind == Support::Kind::kFixed ? "\"fixed\"" : "\"roller\"") +
                     ", \"where\": " + regionText(support.where);
  if (support.displacement != Eigen::Vector3d::Zero())
    text += ", \"displacement_mm\": " + vectorText(support.displacement);
  return text + "}";
}

namespace {

std::string loadBody(const Pressure& load) {
  return "\"pressure\", \"where\": " + regionText(load.where) +
         ", \"MPa\": " + numberText(load.pressure);
}

std::string loadBody(const UniformTraction& load) {
  return "\"traction\", \"where\": " + regionText(load.where) +
         ", \"MPa\": " + vectorText(load.traction);
}

std::string loadBody(const Bump& load) {
  return "\"bump\", \"center_mm\": " + vectorText(load.center) +
         ", \"radius_mm\": " + numberText(load.radius) +
         ", \"peak_MPa\": " + numberText(load.peak) +
         ", \"direction\": " + vectorText(load.direction);
}

}  // namespace

std::string loadText(const Load& load) {
  return "{\"name\": " + quoted(load.name) +
         ", \"kind\": " + std::visit([](const auto& what) { return loadBody(what); }, load.what) +
         "}";
}

std::string touchText(const Touch& touch) {
  const TouchKindInfo& kind = infoOf(touch.kind);
  std::string text = "{\"name\": " + quoted(touch.name) + ", \"kind\": \"" + kind.name +
                     "\", \"at_mm\": " + vectorText(touch.at);
  if (kind.needsVector || touch.vector != Eigen::Vector3d::Zero())
    text += std::string(", \"") + kind.vectorKey + "\": " + vectorText(touch.vector);
  if (touch.radius) text += ", \"radius_mm\": " + numberText(*touch.radius);
  if (kind.presses && touch.friction != 0.0)
    text += ", \"friction\": " + numberText(touch.friction);
  return text + "}";
}

std::string meshText(const MeshSettings& mesh) {
  std::string text = "{\"edge_length_mm\": " + numberText(mesh.edgeLength);
  if (!mesh.patchFactors.empty()) {
    std::string factors;
    for (const auto& [patch, factor] : mesh.patchFactors)
      factors += (factors.empty() ? "" : ", ") + quoted(patch) + ": " + numberText(factor);
    text += ", \"patch_factors\": {" + factors + "}";
  }
  if (mesh.engine != Engine::kAutomatic)
    text += std::string(", \"engine\": ") +
            (mesh.engine == Engine::kSplines ? "\"splines\"" : "\"triangles\"");
  if (mesh.accuracy != MeshSettings{}.accuracy)
    text += ", \"accuracy\": " + numberText(mesh.accuracy);
  if (mesh.elementLength) text += ", \"element_length_mm\": " + numberText(*mesh.elementLength);
  if (mesh.refinementLevels > 0 || mesh.refineAtSharpEdges || mesh.refineAtBorders) {
    std::vector<std::string> at;
    if (mesh.refineAtSharpEdges) at.push_back("sharp_edges");
    if (mesh.refineAtBorders) at.push_back("support_borders");
    text += ", \"refinement\": {\"levels\": " + std::to_string(mesh.refinementLevels) +
            ", \"at\": " + listText(at, quoted) + "}";
  }
  return text + "}";
}

std::string materialText(const Material& material) {
  return "{\"name\": " + quoted(material.name) +
         ", \"youngs_modulus_MPa\": " + numberText(material.youngsModulus) +
         ", \"poisson_ratio\": " + numberText(material.poissonRatio) + "}";
}

}  // namespace palpa::modeling
