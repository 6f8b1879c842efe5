#include "modeling/project/migration.h"

#include <numbers>

#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

/// Version 2 added mesh bodies, primitives, smooth edges, patch factors and spline elements, and
/// kept all other keys.
void fromVersion1(json& document) {
  const auto refuse = [](const json& object, const char* key, const std::string& path) {
    if (object.is_object() && object.contains(key))
      throw ModelingError(path + key + ": unknown key in a file of version 1 (new in version 2)");
  };
  refuse(document, "mesh_body", "");
  refuse(document, "primitive", "");
  if (document.contains("solid")) refuse(document["solid"], "smooth_edges", "solid.");
  if (document.contains("mesh"))
    for (const char* key : {"patch_factors", "engine", "accuracy", "spline_density",
                            "feature_fraction", "element_length_mm"})
      refuse(document["mesh"], key, "mesh.");
  document["version"] = 2;
}

/// Version 3 renamed balls, nothing else.
void fromVersion2(json& document) {
  if (document.contains("touches"))
    for (json& touch : document["touches"]) upgradeKind(touch);
  document["version"] = 3;
}

Solid withSmoothEdgesFound(const Solid& solid) {
  const std::vector<bool> sharp =
      sharpEdges(solid, SurfaceEvaluator(solid), kSmoothAngle * std::numbers::pi / 180.0);
  std::vector<int> smooth;
  for (std::size_t edge = 0; edge < sharp.size(); ++edge)
    if (!sharp[edge]) smooth.push_back(static_cast<int>(edge));
  return solid.withSmoothEdges(smooth, true);
}

}  // namespace

int migrateDocument(json& document) {
  const int fileVersion = document["version"];
  if (fileVersion <= 1) fromVersion1(document);
  if (fileVersion <= 2) fromVersion2(document);
  return fileVersion;
}

void upgradeKind(json& touch) {
  if (!touch.is_object() || !touch.contains("kind") || !touch["kind"].is_string()) return;
  json& kind = touch["kind"];
  kind = std::string(presentKindName(kind.get_ref<const std::string&>()));
}

void migrateProject(Project& project, int fileVersion) {
  if (fileVersion == 1) project.body = withSmoothEdgesFound(std::get<Solid>(project.body));
}

}  // namespace palpa::modeling
