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

/// Validates a document against one of the schemas; references from the commands' schema into
/// project.schema.json are followed. Throws ModelingError with the first violation in
/// document order: `source: supports[0].kind: found "glued", expected one of "fixed", "roller"`.
///
/// valijson decides whether the document is valid. It cannot say why in words for users (no value
/// found, no value expected), and it collects all errors of a document, however many; so the
/// description comes from a second walk along the schema that stops at the first violation.
void checkAgainstSchema(const nlohmann::json& document, const std::string& source,
                        SchemaName schema = SchemaName::kProject);

}  // namespace palpa::modeling
