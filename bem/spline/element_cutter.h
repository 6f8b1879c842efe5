#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bem/spline/border_functions.h"
#include "bem/spline/cut_map.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Samples per direction of an element, to find where a border runs.
inline constexpr int kBorderSamples = 9;
/// Slices along the side of a rectangle that are thinner than this fraction of it are not cut off:
/// the border then runs along the side.
inline constexpr double kThinnestSlice = 1e-3;

/// Piece of a knot rectangle on one side of a border.
struct ElementPiece {
  struct Rectangle {
    std::array<double, 2> lower, upper;
    double at(int direction, double fraction) const {
      return lower[direction] + fraction * (upper[direction] - lower[direction]);
    }
    double size(int direction) const { return upper[direction] - lower[direction]; }
  };
  Rectangle rectangle;
  std::optional<CutMap> map;  ///< where the border bounds the piece
  bool isInside;              ///< the level function is negative
};

/// Cuts the knot rectangle of one element along the border where `level` vanishes. Quarters it
/// until the border is a graph over one of the two directions. `hasRoots`: the coordinate across
/// the border is the root of the distance.
std::vector<ElementPiece> cutElement(const SplineSurface& surface, int element,
                                     const LevelFunction& level, bool hasRoots);

}  // namespace palpa::bem
