#pragma once

#include <vector>

#include "modeling/body/mesh_body.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Flat triangles with all corners on a round surface enclose too little: a rod with chords of 20°
/// has 2 % less section and 4 % less stiffness in bending than the round one. This function moves
/// the vertices outwards (in holes: into the hole) until the triangles are as far outside the
/// surface as inside, which leaves an error of fourth instead of second order in the chord's angle.
///
/// `gaps`: mm, one per triangle, the mean distance of the surface from the flat triangle, positive
/// on the outer side; 0 in flat faces. Vertices of flat faces stay in their planes. A vertex moves
/// by at most twice the largest gap beside it; `data` keeps its topology.
void balanceGaps(MeshBody::Data& data, const std::vector<double>& gaps);

}  // namespace palpa::modeling
