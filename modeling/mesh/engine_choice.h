#pragma once

#include <span>

#include "modeling/body/body.h"
#include "modeling/mesh/mesh_settings.h"

namespace palpa::modeling {

/// The engine that `wanted` stands for. Automatic: splines on a solid whose supports consist of
/// whole patches, otherwise quadratic triangles. At the border of a support, stresses are
/// unbounded; quadratic triangles follow it wherever it runs, splines only along patch edges
/// (docs/decisions/039-engine-by-supports.md).
Engine engineFor(const Body& body, Engine wanted, std::span<const MeshRegion> regions);

}  // namespace palpa::modeling
