#pragma once

#include <filesystem>

#include "base/job.h"
#include "modeling/project/project.h"

namespace palpa::gui {

/// Which triangles a mesh file gets.
enum class ExportedSurface {
  kModelMesh,     ///< of the simulation: the project's edge length, nodes on the true surface
  kDrawnSurface,  ///< the finer ones that are drawn
  kOwnTriangles,  ///< of a mesh body, as it was imported
};

/// Writes the body of a project: the solid to .step, .stp, .iges, .igs and .brep, triangles to
/// .stl, .obj, .ply and .vtp, the whole project to .json. `surface` matters for triangles only;
/// kOwnTriangles is taken as kModelMesh for a solid. @throws ModelingError, ViewError, Cancelled
void exportBody(const modeling::Project& project, const std::filesystem::path& path,
                ExportedSurface surface, const Job& job);

}  // namespace palpa::gui
