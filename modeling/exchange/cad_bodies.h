#pragma once

#include "base/job.h"
#include "modeling/exchange/cad_read.h"
#include "modeling/exchange/cad_solid.h"
#include "modeling/exchange/file_bodies.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// The list of the solids without sizes and volumes.
FileBodies nameSolids(const CadContent& content, const CadSolids& solids);

/// The list of the solids, in mm as in the file; in the order of solids.shapes.
FileBodies describeSolids(const CadContent& content, const CadSolids& solids, ListedSurface surface,
                          const Job& job);

}  // namespace palpa::modeling
