#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace palpa::modeling {

/// resources/project.schema.json, commands.schema.json and recording.schema.json, built into the
/// library.
extern const char* const kProjectSchema;
extern const char* const kCommandsSchema;
extern const char* const kRecordingSchema;

enum class SchemaName { kProject, kCommands, kRecording };

/// Validates a document against one of the schemas. Throws ModelingError with the first violation:
/// `source: supports[0].kind: found "glued", expected one of "fixed", "roller"`. Cost: about 0.1 µs
/// per value.
void checkAgainstSchema(const nlohmann::json& document, const std::string& source,
                        SchemaName schema = SchemaName::kProject);

/// A JSON schema, draft 7, as rules that can be checked and explained. Knows the keywords that the
/// schemas in resources/ use. Immutable.
class JsonSchema {
 public:
  /// References to `project.schema.json#/…` lead into `project`, all others into `document`. Throws
  /// std::invalid_argument for an unknown keyword or type.
  explicit JsonSchema(const nlohmann::json& document, const nlohmann::json& project = {});
  ~JsonSchema();

  /// The first violation in words, beginning with its location: `supports[0].name: is missing`.
  /// Unknown keys precede missing ones, because a misspelt key causes both. None for a valid value.
  std::optional<std::string> violation(const nlohmann::json& value) const;

 private:
  struct Rule;

  const Rule* compile(const nlohmann::json& node, const nlohmann::json& document,
                      const nlohmann::json& project);

  std::map<const nlohmann::json*, std::unique_ptr<Rule>> rules_;  // by their place in a schema
  const Rule* root_ = nullptr;
};

}  // namespace palpa::modeling
