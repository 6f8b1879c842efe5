#pragma once

#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Checks degree, knots and points of a curve before any computation with them. Throws
/// ModelingError if one is invalid; `path` is the beginning of the message, which reads as for
/// patches: `path.knots[5]: 0.4 is smaller than …`.
void checkProfileCurve(const ProfileCurve& curve, const std::string& path);

// Complete checks of one curve, with the messages of makePrimitive(), in a millisecond to some ten:
// all rules except the rules that depend on other curves or on the whole body. They throw
// ModelingError, as ProfileError where the location is known.

/// Rules of RevolveShape.
void checkRevolvedProfile(const ProfileCurve& curve);
/// Rules of ExtrudeShape and of a section of LoftShape.
void checkClosedProfile(const ProfileCurve& curve, const std::string& path);

}  // namespace palpa::modeling
