#pragma once

#include <span>

#include "modeling/mesh/mesh_settings.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Nodes that refinement adds to the plain mesh, roughly. Along a source line of length l the size
/// grows with the distance s as a + g s from a = h / 2^levels to h, so that on each side
///   l ∫ (1 / (a + g s)² - 1 / h²) ds = l ((1/a - 1/h) / g - (h - a) / (g h²))
/// nodes are added. Lengths of half space borders are measured on a coarse sampling of the patches.
/// The sum ignores that the surroundings of several lines overlap, but never exceeds the count of a
/// mesh that is fine everywhere (twice, for the diagonals).
double refinementNodes(const Solid& solid, const SurfaceEvaluator& surface,
                       const MeshSettings& settings, std::span<const MeshRegion> regions);

/// Nodes that thin strokes add to the plain mesh, roughly, as if they lay on the surface at their
/// full length and apart from each other; at most those of a mesh that is as fine everywhere.
double strokeNodes(const SurfaceEvaluator& surface, const MeshSettings& settings,
                   std::span<const MeshRegion> regions);

}  // namespace palpa::modeling
