#pragma once

#include <vector>

#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

/// Mesh of curved six-node triangles on the surface of a body, in the form of flat triangles
/// between their nodes: each triangle of `corners` becomes an element of four consecutive triangles
/// (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca) with the middle nodes ab, bc, ca of its
/// edges. The nodes of `corners`, a mesh of this body, keep their numbers. Triangles of `corners`
/// at corners of supports and between notches are halved first (splitSupportChords()).
///
/// Middle nodes lie on the true surface near the middle of their edge, or near the quarter at the
/// border of a support or a notch (base/support_border.h): on edges of patches and faces, and on
/// the borders of regions, where their edge does. Where an element would be folded, the middle
/// nodes of its edges are moved onto the straight edges. Cost: about 5 µs per triangle.
///
/// `isSupported`: per triangle of `corners`, true in supports; empty: nowhere.
SurfaceMesh quadraticMesh(SurfaceMesh corners, const Body& body,
                          std::vector<bool> isSupported = {});

}  // namespace palpa::modeling
