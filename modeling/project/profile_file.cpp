#include "modeling/project/profile_file.h"

#include "modeling/error.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_schema.h"
#include "modeling/project/json_values.h"
#include "modeling/project/schema_check.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

constexpr JsonLimits kLimits{kMaxProfileFile, 20'000, 8};

/// A document that follows a schema, which may refer to the definitions of project files.
json readChecked(const std::filesystem::path& path, const json& schema) {
  const std::string text = readTextFile(path, kMaxProfileFile);
  json document = parseGuarded(text, path.string(), kLimits);
  const json project = json::parse(kProjectSchema);
  if (const auto found = JsonSchema(schema, project).violation(document))
    throw ModelingError(path.string() + ": " + *found);
  return document;
}

}  // namespace

ProfileCurve readProfileCurve(const std::filesystem::path& path) {
  return profileFrom(readChecked(path, {{"$ref", "project.schema.json#/definitions/profile"}}));
}

std::vector<LoftShape::Section> readSections(const std::filesystem::path& path) {
  const json section{{"$ref", "project.schema.json#/definitions/section"}};
  return sectionsFrom(readChecked(path, {{"type", "array"}, {"items", section}}));
}

}  // namespace palpa::modeling
