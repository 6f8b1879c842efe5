#pragma once

#include <string>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"

namespace palpa::cli {

/// Help text for the files that `solve` and `touch` write: .json holds the report, .vtp the
/// undeformed mesh with displacement and traction, other mesh files the deformed shape.
std::string resultFileHelp();

/// Throws ModelingError if the ending is none of these. Call it before long work.
void requireResultFileName(const std::string& path);

/// The report as text, with a line break at the end; bytes that are not UTF-8 are replaced.
std::string jsonText(const Json& report);

/// Writes a file, or to a pipe or device. Throws OutputError or FileError.
void writeText(const std::string& text, const std::string& path);

/// Writes a file of resultFileHelp(). Throws OutputError, FileError or ModelingError.
void writeResult(const app::TouchModel& model, const app::TouchState& state, const Json& report,
                 const std::string& path);

}  // namespace palpa::cli
