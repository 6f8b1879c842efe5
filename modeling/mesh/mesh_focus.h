#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

namespace palpa::modeling {

/// Part of the surface with a finer mesh: the place of a touch or of a small load.
struct MeshFocus {
  Eigen::Vector3d center;  ///< mm, on or near the surface
  double radius;           ///< mm, > 0
  /// Wanted distance of adjacent nodes within half of the radius, mm; beyond it grows by
  /// kSizeGrowth per distance. No effect where it exceeds the edge length of the settings.
  double edgeLength;

  bool operator==(const MeshFocus&) const = default;
};

/// True if an edge from a to b (mm) is within half of the radius of a focus.
bool isAtFocus(const MeshFocus& focus, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// True if the foot of the centre on the plane of a triangle lies in the triangle, and is nearer
/// than half of its longest edge: a large triangle may contain a focus that is far from its edges.
bool isAtFocus(const MeshFocus& focus, const std::array<Eigen::Vector3d, 3>& triangle);

/// Rough number of nodes that the foci add to a mesh with the given edge length (mm), as
/// refinementNodes() for lines: ∫ (1 / l(s)² - 1 / h²) dA over the plane around each focus.
double focusNodes(std::span<const MeshFocus> foci, double edgeLength, double areaPerNode);

}  // namespace palpa::modeling
