#pragma once

#include <string>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"

namespace palpa::cli {

/// The files `solve` and `touch` write: .json holds the report, .vtp the undeformed mesh with
/// displacement and traction, .stl, .obj and .ply the deformed shape.
inline constexpr const char* kResultFileHelp =
    "Result file: .json (the report), .vtp (mesh with fields), .stl, .obj or .ply (deformed shape)";

/// Throws ViewError when the ending is none of these. To be called before the long work.
void requireResultFileName(const std::string& path);

std::string jsonText(const Json& report);

/// Throws OutputError.
void writeText(const std::string& text, const std::string& path);

void writeResult(const app::TouchModel& model, const app::TouchState& state, const Json& report,
                 const std::string& path);

}  // namespace palpa::cli
