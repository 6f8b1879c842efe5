#pragma once

#include <nlohmann/json.hpp>
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

}  // namespace palpa::modeling
