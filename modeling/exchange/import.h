#pragma once

#include "modeling/exchange/cad_import.h"

namespace palpa::modeling {

/// Reads a body from a file of a format of isImportable(), chosen by the file's ending: a CAD file
/// with importCad(), a mesh file as a mesh body. Adds sizeWarning() to the notes. Throws
/// ModelingError as importCad() and readMeshFile(), and for any other ending; Cancelled.
ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options = {},
                        const Job& job = {});

}  // namespace palpa::modeling
