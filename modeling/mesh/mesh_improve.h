#pragma once

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Improves badly shaped triangles by flips, collapses of their shortest edge and moves of their
/// nodes, worst first, until no operation helps. Good triangles keep their shape. Deterministic.
/// Throws Cancelled, as the other functions here.
void improveShapes(MeshEditor& editor);

/// Bisects the longest edges of slivers between a border and a nearby patch edge, which
/// improveShapes() cannot remove, until the triangles are as short as the gap is wide. Adds nodes
/// along the gap only.
void relieveSlivers(MeshEditor& editor);

/// Closes the wedges where a border leaves a patch edge at a small angle: no mesh can fill them
/// with good triangles, so the border follows the patch edge until it is `borderError` (mm) away.
/// Then improves the surrounding triangles.
void closeWedges(MeshEditor& editor, double borderError);

}  // namespace palpa::modeling
