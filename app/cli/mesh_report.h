#pragma once

#include <string>

#include "app/cli/command.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::cli {

/// What a mesh of a mesh body leaves out, as a line; empty if it leaves out nothing.
std::string toText(const modeling::MeshSimplification& simplification);
/// The same as the entry "simplified".
void addTo(Json& report, const modeling::MeshSimplification& simplification);

/// Counts and quality of a mesh: nodes, triangles, smallest angle, edge lengths, features meshed
/// over.
Json toJson(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality);
std::string toText(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality);

}  // namespace palpa::cli
