#pragma once

#include <filesystem>
#include <string>

#include "modeling/exchange/cad_import.h"

// Internal to modeling/exchange/.
namespace palpa::modeling {

/// The body in the CAD file `path` with content `text`, as importCad() gives it, but without the
/// rehearsal: on some damaged files OpenCASCADE crashes. To be called within an OpenCascadeSession.
/// @throws ModelingError, Cancelled
ImportedBody readCadBody(const std::filesystem::path& path, const std::string& text,
                         const ImportOptions& options, const Job& job);

}  // namespace palpa::modeling
