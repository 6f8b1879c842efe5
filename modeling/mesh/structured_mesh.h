#pragma once

#include "modeling/mesh/mesh_counts.h"
#include "modeling/mesh/work_mesh.h"

namespace palpa::modeling {

/// Structured mesh of a solid: every patch is a grid with the given counts; patches share the nodes
/// on their edges. Nodes on edges are equally spaced in arc length, closer where the edge bends
/// strongly; grid lines inside a patch are straight in the parameters between the points on
/// opposite sides. Each cell is split along its better diagonal. `edgeLengths` holds the wanted
/// edge length (mm) on each patch. The solid and the evaluator must outlive the result. Throws
/// Cancelled.
WorkMesh structuredMesh(const Solid& solid, const SurfaceEvaluator& surface, const Counts& counts,
                        const std::vector<double>& edgeLengths, const Job& job = {});

}  // namespace palpa::modeling
