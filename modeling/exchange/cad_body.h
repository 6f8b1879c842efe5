#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "modeling/exchange/cad_import.h"

// Internal to modeling/exchange/.
namespace palpa::modeling {

/// The body in the CAD file `path` with the content `text`, as from importCad(), but in this
/// process: on some damaged files OpenCASCADE crashes. The caller must hold an OpenCascadeSession.
/// Throws ModelingError as importCad(); Cancelled.
ImportedBody readCadBody(const std::filesystem::path& path, const std::string& text,
                         const ImportOptions& options, const Job& job);

/// Reads all solids of the file, whose text is read once, and passes the outcome of each in the
/// order of the file to `take`. Solids that `wants` refuses are left out. Otherwise as
/// readCadBody(); `options.solid` has no meaning.
void readCadBodies(const std::filesystem::path& path, const std::string& text,
                   const ImportOptions& options, const std::function<bool(std::size_t)>& wants,
                   const TakeBody& take, const Job& job);

/// The list of the solids of the file, in mm, likewise.
FileBodies listCadBodies(const std::filesystem::path& path, const std::string& text,
                         ListedSurface surface, const Job& job);

}  // namespace palpa::modeling
