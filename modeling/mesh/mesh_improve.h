#pragma once

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Improves badly shaped triangles by flips, collapses of their shortest edge and moves of their
/// nodes, worst first, until nothing helps. Good triangles stay as they are. Deterministic.
void improveShapes(MeshEditor& editor);

/// Bisects the longest edges of slivers that improveShapes() could not remove because they are
/// caught between a border and a nearby patch edge, until the triangles are as short as the gap is
/// wide. Costs nodes along the gap only.
void relieveSlivers(MeshEditor& editor);

}  // namespace palpa::modeling
