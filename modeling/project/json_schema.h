#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace palpa::modeling {

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
