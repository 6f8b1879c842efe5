#pragma once

#include <functional>
#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Part of a surface: some whole patches, and the region of the other patches where a level
/// function is negative; both without the exceptions.
struct SurfacePart {
  std::vector<bool> patches;          ///< per patch; empty: no whole patches
  LevelFunction level;                ///< null: no other patches
  std::vector<bool> exceptPatches{};  ///< per patch; empty: none
  LevelFunction exceptLevel{};        ///< null: nothing else is excepted

  bool hasPatch(int patch) const { return !patches.empty() && patches[patch]; }
  bool lacksPatch(int patch) const { return !exceptPatches.empty() && exceptPatches[patch]; }

  /// The part within one patch: the whole patch, nothing of it, or where `level` is negative.
  /// Refers to the SurfacePart.
  struct OnPatch {
    bool isWhole = false;
    LevelFunction level;  ///< null: whole or nothing
    bool contains(const Eigen::Vector3d& x) const { return level ? level(x) < 0 : isWhole; }
  };
  OnPatch on(int patch) const;
};

/// Treatment of functions that the border of a part cuts.
enum class Tearing {
  kRoots,  ///< weighted and extended functions beside the border, see BorderFunctions
  kTorn,   ///< functions cut by the border get one coefficient per side
  kWhole
};

/// Surface in which the elements inside a part have the tag `tagInside` returns for their present
/// tag; elements that keep their tag count as outside. Knot rectangles crossed by the border of the
/// part are cut along it into separate elements.
///
/// The displacement is prescribed inside a support, and this must not affect the surface beyond the
/// border within the width of a function. Where the level is smooth, functions beside the border
/// belong to one side each and have the root of the distance as a factor (kRoots; BorderFunctions).
/// All supports of a surface must then be smooth. Otherwise functions are torn: each side
/// gets its own coefficient (SplineSurface::tornFrom). A function with less than a thousandth of
/// its area on one side is not torn; it belongs to the other side (SplineSurface::barelyReaches).
/// Loads cut elements without tearing functions: tractions jump at their border, displacements do
/// not.
///
/// The border may have any shape that is simple within a 64th of a knot rectangle. Finer features
/// count as inside or outside by their midpoint, and slices thinner than a thousandth of a
/// rectangle are not cut off. Parts may be cut one after another.
SplineSurface withPart(const SplineSurface& surface, const SurfacePart& part,
                       const std::function<int(int)>& tagInside, Tearing tearing);
/// Surface cut by a support with the tag `tag`, which lies where `level` is negative.
SplineSurface withPart(const SplineSurface& surface, const LevelFunction& level, int tag,
                       Tearing tearing = Tearing::kTorn);

}  // namespace palpa::bem
