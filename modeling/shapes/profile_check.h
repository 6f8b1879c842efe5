#pragma once

#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Checks degree, knots and points of a curve before any computation with them. Throws
/// ModelingError if one is invalid; `path` is the beginning of the message, which reads as for
/// patches: `path.knots[5]: 0.4 is smaller than …`.
void checkProfileCurve(const ProfileCurve& curve, const std::string& path);

}  // namespace palpa::modeling
