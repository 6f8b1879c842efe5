#pragma once

#include <string>
#include <vector>

#include "modeling/mesh/surface_mesh.h"

// Properties of finished meshes, computed independently of the mesher.
namespace palpa::modeling::checks {

/// Description of the first fault of a mesh; empty if every edge is used once in each direction,
/// every node is used, and the Euler characteristic is 2, as of a sphere.
std::string manifoldFault(const SurfaceMesh& mesh);

double enclosedVolume(const SurfaceMesh& mesh);
double totalArea(const SurfaceMesh& mesh);
double regionArea(const SurfaceMesh& mesh, int region);

/// Largest distance of a node from the surface point at its parameters.
double distanceFromSurface(const SurfaceMesh& mesh, const Solid& solid);

/// Nodes that triangles of a region share with others, ascending.
std::vector<int> borderNodes(const SurfaceMesh& mesh, int region);

/// Largest |normal · x - below| over borderNodes().
double borderFault(const SurfaceMesh& mesh, int region, const HalfSpace& half);

}  // namespace palpa::modeling::checks
