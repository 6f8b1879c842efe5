#pragma once

#include <vector>

#include "modeling/mesh/middle_nodes.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

/// Splits the edges that join two vertices on the border of supports or on notches without being of
/// these, as in a triangle at the corner of a support. Around such vertices six-node triangles take
/// the square root of the distance from the border as their coordinate (base/support_border.h),
/// which needs triangles with one vertex or one edge on it. Edges across a narrow support, or
/// between two supports close to each other, stay: their ends are no neighbours of one vertex of
/// the border. Edges from a notch to another one or to the border of a support are all split.
///
/// `isSupported`: per triangle of the mesh; values of new triangles are appended. `middles`: of
/// this mesh. New nodes and triangles have the largest numbers.
void splitSupportChords(SurfaceMesh& mesh, std::vector<bool>& isSupported,
                        const MiddleNodes& middles);

}  // namespace palpa::modeling
