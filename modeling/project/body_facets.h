#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "modeling/body/body.h"

// Internal to modeling/project.
namespace palpa::modeling {

/// Surface of a body as triangles: of a mesh body its triangles, of a solid a tessellation.
/// Lengths in mm.
struct BodyFacets {
  struct Facet {
    std::array<Eigen::Vector3d, 3> corners;  ///< counter-clockwise seen from outside
    int patch = 0;                           ///< index into patchNames()
    Eigen::Vector3d areaNormal;              ///< outwards, as long as the area (mm²)

    Eigen::Vector3d centre() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
  };

  /// Facets without area are omitted.
  std::vector<Facet> facets;
  /// Pieces of the edges at which the surface turns by kSharpEdgeDegrees or more, and very short
  /// pieces at the tips of cones.
  std::vector<std::array<Eigen::Vector3d, 2>> sharpEdges;
  /// Pairs of patches with a common edge.
  std::vector<std::array<int, 2>> neighbours;
  double size = 0.0;  ///< diagonal of the body's box
};

/// Cost: some milliseconds per ten thousand triangles.
BodyFacets bodyFacets(const Body& body);

}  // namespace palpa::modeling
