#include "base/text.h"
#include "modeling/project/atomic_write.h"
#include "modeling/project/json_values.h"
#include "modeling/project/project_file.h"

namespace palpa::modeling {
namespace {

template <class T, class Text>
std::string objectsText(const std::vector<T>& list, Text text) {
  std::vector<std::string> lines;
  for (const T& one : list) lines.push_back(text(one));
  return linesText(lines, "  ");
}

std::string bodyText(const Solid& solid) {
  return "\"solid\": " + solidText(solid);
}

std::string bodyText(const MeshBody& body) {
  return "\"mesh_body\": " + meshBodyText(body);
}

}  // namespace

std::string toJson(const Project& project) {
  std::string text =
      "{\n  \"format\": \"palpa-project\",\n  \"version\": " + std::to_string(kProjectVersion) +
      ",\n  \"name\": " + quoted(project.name) +
      ",\n  \"material\": " + materialText(project.material) + ",\n  " +
      std::visit([](const auto& body) { return bodyText(body); }, project.body);
  if (project.primitive) text += ",\n  \"primitive\": " + primitiveText(*project.primitive);
  text += ",\n  \"supports\": " + objectsText(project.supports, supportText) +
          ",\n  \"loads\": " + objectsText(project.loads, loadText) +
          ",\n  \"touches\": " + objectsText(project.touches, touchText) +
          ",\n  \"mesh\": " + meshText(project.mesh);
  if (!project.view.empty()) text += ",\n  \"view\": " + project.view;
  return text + "\n}\n";
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
