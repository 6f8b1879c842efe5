#pragma once

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Makes the border of half space k (of editor.halfSpaces()) a chain of mesh edges and sets bit k
/// of every triangle's sides.
///
/// Where the border crosses a mesh edge close to one end, that node moves onto it (along a patch
/// edge only if the node lies on one; corners never). What is still crossed is cut at the crossing
/// on the true surface. A node that cannot move but lies within a few per cent of an edge length of
/// the border counts as on it: cutting there would make slivers.
void fitToBorder(MeshEditor& editor, int k);

}  // namespace palpa::modeling
