#pragma once

#include <string>

#include "app/cli/command.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::cli {

/// Counts and quality of a mesh: nodes, triangles, smallest angle, edge lengths, features meshed
/// over.
Json toJson(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality);
std::string toText(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality);

}  // namespace palpa::cli
