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

/// Where a border leaves a patch edge at a small angle no mesh can fill the wedge between them with
/// good triangles: there the border runs along the patch edge until it is `borderError` (mm) away.
/// Improves the triangles around.
void closeWedges(MeshEditor& editor, double borderError);

}  // namespace palpa::modeling
