#include "modeling/project/schema_check.h"

#include <stdexcept>

#include "modeling/error.h"
#include "modeling/project/json_schema.h"

namespace palpa::modeling {

using nlohmann::json;

void checkAgainstSchema(const json& document, const std::string& source, SchemaName schema) {
  const auto compiled = [&]() -> const JsonSchema& {
    switch (schema) {
      case SchemaName::kProject: {
        static const JsonSchema project(json::parse(kProjectSchema));
        return project;
      }
      case SchemaName::kCommands: {
        static const JsonSchema commands(json::parse(kCommandsSchema), json::parse(kProjectSchema));
        return commands;
      }
      case SchemaName::kRecording: {
        static const JsonSchema recording(json::parse(kRecordingSchema));
        return recording;
      }
    }
    throw std::invalid_argument("checkAgainstSchema: unknown schema");
  };
  if (const auto found = compiled().violation(document))
    throw ModelingError(source + ": " + *found);
}

}  // namespace palpa::modeling
