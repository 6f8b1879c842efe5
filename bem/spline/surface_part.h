#pragma once
#include <functional>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Negative inside of a part of the surface, positive outside, zero on its border; by position, mm.
using LevelFunction = std::function<double(const Eigen::Vector3d&)>;

/// Gives the elements inside a part a tag. Knot rectangles that its border crosses are cut along it
/// into pieces of their own. What is known inside the part, a support's displacement, must not
/// reach across the border by the width of a function: functions that the border cuts are torn,
/// each side gets a coefficient of its own (SplineSurface::tornFrom). A function with less than a
/// tenth of its area on one side is not torn but belongs to the other side
/// (SplineSurface::barelyReaches).
///
/// The border may have any shape that is simple within a 64th of a knot rectangle; what is finer is
/// taken as inside or outside by its middle, and slices thinner than a thousandth of a rectangle
/// are not cut off.
SplineSurface withPart(const SplineSurface& surface, const LevelFunction& level, int tag);

}  // namespace palpa::bem
