#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modeling/mesh/region_border.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {

/// What a mesh left out of a body.
struct MeshSimplification {
  double below = 0;       ///< mm: smaller features were meshed over; 0: none
  double moved = 0;       ///< mm, the largest distance of the surface from the rest of the body's
  int vanishedFaces = 0;  ///< of the body
  double partsBelow = 0;  ///< mm: thinner pins and narrower holes may be missing
  int cutPins = 0;        ///< pins and knife edges that are missing
  int filledHoles = 0;    ///< holes and gaps that are missing
};

/// Closed, oriented triangle mesh of a body's surface.
///
/// Every node lies on the body's surface; every triangle lies in one patch; patches share the nodes
/// on edges and in corners. Triangles are counter-clockwise seen from outside. Nodes with close
/// numbers are close in space (patch by patch along a Hilbert curve in the parameters).
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> positions;    ///< mm
  std::vector<SurfaceParameter> parameters;  ///< per node, in the first of its patches
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> patchOfTriangle;
  std::vector<int> smoothingGroupOfTriangle;        ///< normals are continuous inside a group
  std::vector<std::vector<int>> trianglesOfRegion;  ///< per region passed to mesh(), ascending
  std::vector<RegionBorder> borders;  ///< the distinct half spaces and paintings of the regions
  std::vector<std::uint64_t> bordersOfTriangle;  ///< bit k: inside borders[k]
  MeshSimplification simplification;             ///< of a mesh body
  /// True if each four consecutive triangles are the quarters of a curved six-node triangle, see
  /// quadraticMesh().
  bool isQuadratic = false;
};

/// Extreme angles, aspects and edge lengths of a mesh.
struct MeshQuality {
  double smallestAngle = 0.0;  ///< degrees
  double largestAspect = 0.0;  ///< longest side / height on it · √3/2; 1 for equilateral triangles
  double shortestEdge = 0.0;  ///< mm
  double meanEdge = 0.0;      ///< mm
  double longestEdge = 0.0;   ///< mm
};

MeshQuality measureQuality(const SurfaceMesh& mesh);

}  // namespace palpa::modeling
