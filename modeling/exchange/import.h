#pragma once

#include "modeling/exchange/cad_import.h"

namespace palpa::modeling {

/// Reads a body from a file of a format of isImportable(), chosen by the file's ending: a CAD file
/// with importCad(), a mesh file as a mesh body. Adds sizeWarning() to the notes. Throws
/// ModelingError as importCad() and readMeshFile(), and for any other ending; Cancelled.
ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options = {},
                        const Job& job = {});

/// Imports all bodies of a file whose listBodies() are `count`, and passes the outcome of each in
/// the order of the list to `take`. The file is read as often as for one body; `options.solid` has
/// no meaning. A body that cannot be imported does not stop the others. Throws ModelingError as
/// importBody() if the file cannot be read; Cancelled.
void importBodies(const std::filesystem::path& path, std::size_t count,
                  const ImportOptions& options, const TakeBody& take, const Job& job = {});

}  // namespace palpa::modeling
