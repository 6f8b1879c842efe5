#pragma once

#include <array>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Control net of a patch by positions instead of indices, with degrees and knots.
struct PatchNet {
  std::array<int, 2> degree{};
  std::array<std::vector<double>, 2> knots;
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< mm; points[i][j]: i along u, j along v
  std::array<bool, 2>
      changed{};  ///< directions whose knots or degree differ from the original solid
};

/// Net of a patch of a solid, unchanged.
PatchNet netOf(const Solid& solid, int patch);

/// Solid with the patches, edges and smooth flags of `before` and new nets, one per patch.
///
/// The shared points follow from the edges of `before`, never from distances: vertices stay, rows
/// of edges along an unchanged direction stay, and rows along a changed direction are taken from
/// one of their two patches (both computed the same row up to rounding). Points are numbered in the
/// order in which the nets use them. Both patches of an edge must have changed in the same way.
/// Throws ModelingError under the conditions of the Solid constructor.
Solid weld(const Solid& before, const std::vector<PatchNet>& nets);

}  // namespace palpa::modeling
