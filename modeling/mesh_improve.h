#pragma once

#include "modeling/mesh_editor.h"

namespace palpa::modeling {

/// Improves badly shaped triangles by flips, collapses of their shortest edge and moves of their
/// nodes, worst first, until nothing helps. Good triangles stay as they are. Deterministic.
void improveShapes(MeshEditor& editor);

}  // namespace palpa::modeling
