#include <nlohmann/json.hpp>

#include "modeling/error.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_values.h"
#include "modeling/project/migration.h"
#include "modeling/project/project_file.h"
#include "modeling/project/schema_check.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

/// The text of the "view" object with its keys in the order of the file; empty if there is none.
std::string viewText(std::string_view text) {
  using nlohmann::ordered_json;
  const auto onlyView = [](int depth, ordered_json::parse_event_t event, ordered_json& parsed) {
    return depth != 1 || event != ordered_json::parse_event_t::key || parsed == "view";
  };
  const ordered_json document = ordered_json::parse(text, onlyView);
  return document.contains("view") ? document["view"].dump() : std::string();
}

/// A message cut after kMaxLength bytes, between two characters, so that it stays readable if it
/// quotes hostile names or lists thousands of patches.
std::string clipped(std::string message) {
  constexpr std::size_t kMaxLength = 2000;
  if (message.size() <= kMaxLength) return message;
  std::size_t end = kMaxLength;
  while (end > 0 && (static_cast<unsigned char>(message[end]) & 0xC0U) == 0x80U) --end;
  return message.substr(0, end) + "…";
}

/// Checks format and version. It precedes the schema, because newer versions have a different one.
void checkFormat(const json& document, const std::string& source) {
  const auto fail = [&](const std::string& what) { throw ModelingError(source + ": " + what); };
  if (!document.is_object()) fail("this is not a Palpa project: expected an object { … }");
  const auto format = document.find("format");
  if (format == document.end())
    fail("format: is missing; this is not a Palpa project (expected \"palpa-project\")");
  if (*format != "palpa-project")
    fail("format: found " + (format->is_string() ? format->dump() : "no text") +
         ", expected \"palpa-project\"");
  const auto version = document.find("version");
  if (version == document.end()) fail("version: is missing");
  const std::string found =
      "version: found " + (version->is_primitive() ? version->dump() : "a list");
  if (version->is_number() && version->get<double>() > kProjectVersion)
    fail(found + "; this program reads up to version " + std::to_string(kProjectVersion) +
         "; a newer Palpa is needed");
  if (!version->is_number_integer() || *version < 1)
    fail(found + ", expected a whole number from 1 to " + std::to_string(kProjectVersion));
}

Project projectFrom(const json& document) {
  Project project;
  project.name = document.value("name", "");
  project.material = materialFrom(document["material"]);
  if (document.contains("solid"))
    project.body = solidFrom(document["solid"]);
  else
    project.body = meshBodyFrom(document["mesh_body"]);
  if (document.contains("primitive")) project.primitive = primitiveFrom(document["primitive"]);
  for (const json& one : document.value("supports", json::array()))
    project.supports.push_back(supportFrom(one));
  for (const json& one : document.value("loads", json::array()))
    project.loads.push_back(loadFrom(one));
  for (const json& one : document.value("touches", json::array()))
    project.touches.push_back(touchFrom(one));
  for (const json& one : document.value("measurements", json::array()))
    project.measurements.push_back(measurementFrom(one));
  if (document.contains("design")) project.design = designFrom(document["design"]);
  project.mesh = meshFrom(document["mesh"]);
  return project;
}

/// Runs a step and adds the name of the file to its errors.
template <class Step>
auto named(const std::string& source, Step step) {
  try {
    return step();
  } catch (const ModelingError& error) {
    throw ModelingError(source + ": " + error.what(), error.kind());
  } catch (const json::exception& error) {
    throw ModelingError(source + ": " + error.what());
  }
}

Project parseUnclipped(std::string_view text, const std::string& source) {
  const JsonLimits limits{kMaxProjectFile, kMaxProjectValues, kDeepestNesting};
  json document = parseGuarded(text, source, limits);
  checkFormat(document, source);
  const int fileVersion = named(source, [&] { return migrateDocument(document); });
  checkAgainstSchema(document, source);
  return named(source, [&] {
    Project project = projectFrom(document);
    if (document.contains("view")) project.view = viewText(text);
    migrateProject(project, fileVersion);
    checkProject(project);
    return project;
  });
}

}  // namespace

Project parseProject(std::string_view text, const std::string& sourceName) {
  try {
    return parseUnclipped(text, sourceName);
  } catch (const ModelingError& error) {
    throw ModelingError(clipped(error.what()), error.kind());
  }
}

Project readProject(const std::filesystem::path& path) {
  return parseProject(readTextFile(path, kMaxProjectFile), path.string());
}

}  // namespace palpa::modeling
