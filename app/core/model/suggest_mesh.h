#pragma once

#include <optional>

#include "app/core/model/build_touch_model.h"

namespace palpa::app {

/// Mesh settings for a project whose model is too large for memory, or whose mesh of triangles does
/// not bound a body although the body does: settings with another edge length, size of the spline
/// elements or accuracy, whichever the project uses, close to the present ones. They are tried: the
/// model fits into memory and its mesh bounds a body. Nothing if no such setting was found, or if
/// the project fails for another reason. Cost: up to twenty meshes, without any equations.
/// Throws Cancelled.
std::optional<modeling::MeshSettings> suggestMesh(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job);

}  // namespace palpa::app
