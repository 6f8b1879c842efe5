#pragma once

#include <functional>
#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Negative inside of a part of the surface, positive outside, zero on its border; by position, mm.
/// Like a distance it changes by at most 1 mm per mm.
using LevelFunction = std::function<double(const Eigen::Vector3d&)>;

/// A part of a surface: some whole patches, and what a level function says of the others.
struct SurfacePart {
  std::vector<bool> patches;  ///< per patch; empty: none
  LevelFunction level;        ///< null: nothing of the others

  bool hasPatch(int patch) const { return !patches.empty() && patches[patch]; }
};

enum class Tearing {
  kTorn,  ///< functions that the border cuts get a coefficient for each side
  kWhole
};

/// Gives the elements inside a part the tag that `tagInside` says for the one they have. Knot
/// rectangles that its border crosses are cut along it into pieces of their own.
///
/// What is known inside of a support, the displacement, must not reach across the border by the
/// width of a function: functions that the border cuts are torn, each side gets a coefficient of
/// its own (SplineSurface::tornFrom). A function with less than a thousandth of its area on one
/// side is not torn but belongs to the other side (SplineSurface::barelyReaches). Loads cut without
/// tearing: their tractions jump, displacements do not.
///
/// The border may have any shape that is simple within a 64th of a knot rectangle; what is finer is
/// taken as inside or outside by its middle, and slices thinner than a thousandth of a rectangle
/// are not cut off. Parts may be cut one after another.
SplineSurface withPart(const SplineSurface& surface, const SurfacePart& part,
                       const std::function<int(int)>& tagInside, Tearing tearing);
/// A support below the zero of a level function with a tag of its own.
SplineSurface withPart(const SplineSurface& surface, const LevelFunction& level, int tag);

}  // namespace palpa::bem
