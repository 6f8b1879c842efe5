#pragma once

#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Degree, knots and points of a curve, before anything is computed with them. `path` begins the
/// messages, which read as for patches: `path.knots[5]: 0.4 is smaller than …`.
/// @throws ModelingError
void checkProfileCurve(const ProfileCurve& curve, const std::string& path);

}  // namespace palpa::modeling
