#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace palpa::modeling {

/// resources/project.schema.json, built into the library.
extern const char* const kProjectSchema;

/// Validates a document against kProjectSchema. Throws ModelingError with the first violation in
/// document order: `source: supports[0].kind: found "glued", expected one of "fixed", "roller"`.
///
/// valijson decides whether the document is valid. It cannot say why in words for users (no value
/// found, no value expected), and it collects all errors of a document, however many; so the
/// description comes from a second walk along the schema that stops at the first violation.
void checkAgainstSchema(const nlohmann::json& document, const std::string& source);

}  // namespace palpa::modeling
