#pragma once

#include <filesystem>

#include "app/core/page/make_touch_page.h"
#include "base/job.h"
#include "modeling/project/project.h"

namespace palpa::gui {

/// Triangles of a mesh file.
enum class ExportedSurface {
  kModelMesh,     ///< mesh of the simulation: the project's edge length, nodes on the exact surface
  kDrawnSurface,  ///< the finer drawn surface
  kOwnTriangles,  ///< the imported triangles of a mesh body
};

/// Writes a project, the solid of a project as CAD file, the triangles of its body, or a page that
/// can be touched (`page`), depending on the file's ending. `surface` applies to triangles only;
/// kOwnTriangles means kModelMesh for a solid. Throws ModelingError, SolverError, FileError,
/// Cancelled.
void exportBody(const modeling::Project& project, const std::filesystem::path& path,
                ExportedSurface surface, const Job& job, const app::TouchPageSettings& page = {});

}  // namespace palpa::gui
