#pragma once

#include <vector>

#include "modeling/mesh/small_parts.h"

namespace palpa::modeling {

/// Length (mm) per vertex below which edges belong to features that are removed: the smallest of
/// `smallest` there and along the edges there, less on curved surfaces whose radius is not small
/// itself, so that they keep at least ten edges per circle, and less on thin walls, whose thickness
/// stays.
std::vector<double> featureLengths(const FacedTriangles& body, const LengthAt& smallest,
                                   const Job& job);

}  // namespace palpa::modeling
