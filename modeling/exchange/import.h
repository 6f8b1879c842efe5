#pragma once

#include "modeling/exchange/cad_import.h"

namespace palpa::modeling {

/// Reads a body from any file that can be imported, by the ending of its name: the CAD formats of
/// importCad(), and the triangle meshes .stl, .obj and .ply, which become mesh bodies.
/// @throws ModelingError, also for an unknown ending; Cancelled
ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options = {},
                        const Job& job = {});

/// All these endings, for messages.
inline constexpr const char* kImportFileEndings =
    ".step, .stp, .iges, .igs, .brep, .stl, .obj or .ply";

}  // namespace palpa::modeling
