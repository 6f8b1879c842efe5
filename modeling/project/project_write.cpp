#include "modeling/project/atomic_write.h"
#include "modeling/project/json_values.h"
#include "modeling/project/project_file.h"

namespace palpa::modeling {
namespace {

/// Values of a project file with one entry per line.
const std::set<std::string> kOpen{"",
                                  "solid",
                                  "solid.control_points_mm",
                                  "solid.patches",
                                  "solid.patches[]",
                                  "solid.patches[].knots",
                                  "solid.patches[].net",
                                  "solid.smooth_edges",
                                  "mesh_body",
                                  "mesh_body.vertices_mm",
                                  "mesh_body.triangles",
                                  "mesh_body.faces",
                                  "supports",
                                  "loads",
                                  "touches",
                                  "measurements",
                                  "design",
                                  "design.targets"};

}  // namespace

std::string toJson(const Project& project) {
  Json object{{"format", "palpa-project"},
              {"version", kProjectVersion},
              {"name", project.name},
              {"material", jsonOf(project.material)}};
  if (const auto* solid = std::get_if<Solid>(&project.body))
    object["solid"] = jsonOf(*solid);
  else
    object["mesh_body"] = jsonOf(std::get<MeshBody>(project.body));
  if (project.primitive) object["primitive"] = jsonOf(*project.primitive);
  object["supports"] = jsonOfEach(project.supports);
  object["loads"] = jsonOfEach(project.loads);
  object["touches"] = jsonOfEach(project.touches);
  if (!project.measurements.empty()) object["measurements"] = jsonOfEach(project.measurements);
  if (project.design) object["design"] = jsonOf(*project.design);
  object["mesh"] = jsonOf(project.mesh);
  std::string text = jsonText(object, kOpen);
  // The view is kept byte by byte, as the last value.
  if (!project.view.empty())
    text.insert(text.size() - std::string_view("\n}").size(), ",\n  \"view\": " + project.view);
  return text + "\n";
}

std::string checkedText(const Project& project, const std::string& name) {
  checkProject(project);
  std::string text = toJson(project);
  parseProject(text, name + " is not saved");
  return text;
}

void writeProject(const Project& project, const std::filesystem::path& path) {
  writeAtomically(checkedText(project, path.string()), path, {.backup = true});
}

}  // namespace palpa::modeling
