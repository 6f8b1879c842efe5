#pragma once

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Fits the mesh to one border: editor.borders()[k] becomes a chain of mesh edges, and bit k of
/// every triangle's sides is set if the triangle lies inside.
///
/// If the border crosses a mesh edge close to one end, the node at this end moves onto the border.
/// A node on a patch edge moves along this edge only; corners never move. The remaining crossed
/// edges are split at the crossing on the true surface. A patch corner that lies within `tolerance`
/// edge lengths (above 0, below 0.2) of the border counts as on it, because a cut there would make
/// slivers; another node that cannot move, within half of it. Throws Cancelled.
void fitToBorder(MeshEditor& editor, int k, double tolerance);

}  // namespace palpa::modeling
