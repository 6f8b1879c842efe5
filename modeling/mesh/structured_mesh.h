#pragma once

#include "modeling/mesh/mesh_counts.h"
#include "modeling/mesh/work_mesh.h"

namespace palpa::modeling {

/// The structured mesh: every patch a grid with the given counts, nodes on edges shared. Along the
/// edges nodes are equally spaced in arc length, closer where the edge bends strongly; inside,
/// lines run straight in the parameters between the points on opposite sides. Each cell is split
/// along its better diagonal. `edgeLengths` are those wanted on each patch. The solid and the
/// evaluator must outlive the result.
WorkMesh structuredMesh(const Solid& solid, const SurfaceEvaluator& surface, const Counts& counts,
                        const std::vector<double>& edgeLengths, const Job& job = {});

}  // namespace palpa::modeling
