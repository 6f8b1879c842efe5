#pragma once

#include <array>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// The control net of a patch by positions instead of indices, with its degrees and knots.
struct PatchNet {
  std::array<int, 2> degree{};
  std::array<std::vector<double>, 2> knots;
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< points[i][j]: i along u, j along v
  std::array<bool, 2> changed{};  ///< directions whose knots or degree differ from the solid's
};

/// The net of a patch of a solid as it is.
PatchNet netOf(const Solid& solid, int patch);

/// A solid with the patches, edges and smooth flags of `before` over new nets, one per patch.
///
/// Which points are shared follows from the edges of `before`, never from distances: vertices stay,
/// rows of edges along an unchanged direction stay, rows along a changed one are taken from one of
/// their two patches (both computed the same row up to rounding). Points are numbered in the order
/// in which the nets use them. Both patches of an edge must have changed in the same way.
/// @throws ModelingError as the constructor of Solid
Solid weld(const Solid& before, const std::vector<PatchNet>& nets);

}  // namespace palpa::modeling
