#pragma once

#include <span>

#include "modeling/mesh/mesh_settings.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Rough number of nodes that refinement adds to the plain mesh. Along a source line of length l
/// the edge length grows with the distance s as a + g s from a = h / 2^levels to h, so that each
/// side adds
///   l ∫ (1 / (a + g s)² - 1 / h²) ds = l ((1/a - 1/h) / g - (h - a) / (g h²))
/// nodes. Lengths of half space borders are measured on a coarse sampling of the patches. Overlaps
/// of several lines count several times, but the sum never exceeds the node count of a uniformly
/// fine mesh (twice, for the diagonals).
double refinementNodes(const Solid& solid, const SurfaceEvaluator& surface,
                       const MeshSettings& settings, std::span<const MeshRegion> regions);

/// Rough number of nodes that thin strokes add to the plain mesh, assuming that they lie on the
/// surface in their full length and do not overlap; at most the node count of a uniformly fine
/// mesh.
double strokeNodes(const SurfaceEvaluator& surface, const MeshSettings& settings,
                   std::span<const MeshRegion> regions);

}  // namespace palpa::modeling
