#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/body/region.h"
#include "modeling/job.h"
#include "modeling/mesh/region_border.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {

/// Which boundary elements a body is computed with: splines on its patches, or flat triangles.
enum class Engine { automatic, splines, triangles };

struct MeshSettings {
  double edgeLength = 5.0;   ///< target length of triangle legs in mm, > 0
  int refinementLevels = 0;  ///< 0 … 6: the finest size is edgeLength / 2^levels
  bool refineAtSharpEdges = false;
  bool refineAtBorders = false;  ///< along the borders of regions with refineBorder
  /// Patches on which edge and element lengths are multiplied by a factor, 0.05 … 20; 1 for those
  /// not named. Patches around them get as many pieces as needed to fit.
  std::map<std::string, double> patchFactors{};
  Engine engine = Engine::automatic;
  /// Relative error wished for in displacements and reactions with splines, 1e-4 … 0.1: how fine
  /// their elements are, unless elementLength says it.
  double accuracy = 0.01;
  /// Size of the spline elements away from borders in mm, > 0; patchFactors multiply it.
  std::optional<double> elementLength{};

  /// Everything but the names in patchFactors. @throws ModelingError that begins with `path` and
  /// names the field
  void validate(const std::string& path = "mesh") const;
};

/// A region the mesh is fitted to. `name` appears in messages ("supports[0] \"base\"").
struct MeshRegion {
  std::string name;
  Region where;
  bool refineBorder = true;
};

struct MeshQuality {
  double smallestAngle = 0.0;  ///< degrees
  double largestAspect = 0.0;  ///< longest side over the height on it times √3/2; 1 = equilateral
  double shortestEdge = 0.0;   ///< mm
  double meanEdge = 0.0;       ///< mm
  double longestEdge = 0.0;    ///< mm
};

/// Closed, oriented triangle mesh of a solid's surface.
///
/// Every node lies on the spline surface; every triangle lies in one patch; nodes on edges and in
/// corners are shared. Triangles are counter-clockwise seen from outside. Nodes with close numbers
/// are close in space (patch by patch along a Hilbert curve in the parameters).
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> positions;    ///< mm
  std::vector<SurfaceParameter> parameters;  ///< per node, in the first of its patches
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> patchOfTriangle;
  std::vector<int> smoothingGroupOfTriangle;        ///< normals are continuous inside a group
  std::vector<std::vector<int>> trianglesOfRegion;  ///< per region passed to mesh(), ascending
  std::vector<RegionBorder> borders;  ///< the distinct half spaces and paintings of the regions
  std::vector<std::uint64_t> bordersOfTriangle;  ///< bit k: inside borders[k]
};

/// Meshes the solid and fits the mesh to the borders of the regions. Deterministic: the same input
/// gives the same mesh to the last bit.
///
/// The number of pieces along each chain of glued edges follows from arc length / edgeLength, with
/// at least three for a quarter of a circle, closer where it bends; triangles of thin patches are
/// bisected until they are at most about five times as long as high; the border of a half space
/// or painting becomes a chain of mesh edges, so that each triangle lies on one side of it; with
/// refinement the size falls linearly towards sharp edges or borders.
///
/// @throws ModelingError: settings out of range; an unknown patch in patchFactors; a region that
/// selects nothing, or nothing wider than a quarter of the edge length (named); more than
///         kMostNodes nodes (checked before anything is allocated). Cancelled. Progress comes
///         as phase "mesh".
SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

/// The same for a mesh body: its surface, triangulated anew to the edge length. Nodes lie on the
/// body's triangles and have no parameters (the list is empty); they are in the order of a space
/// filling curve. Sharp edges (kSharpAngle), borders of faces and of regions become chains of mesh
/// edges; patches are the body's faces. Where features are closer than the edge length or turn
/// within it, edges are shorter. Cost: about 25 µs per triangle of the body and of the mesh.
/// @throws also ModelingError: the edge length is too coarse for the body (it would lose or gain
///         more than kMostVolumeChange of its volume); Cancelled
SurfaceMesh mesh(const MeshBody& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

inline constexpr double kMostVolumeChange = 0.5;

inline constexpr double kMostNodes = 5e6;

/// About how many nodes mesh() makes: within 5 % without refinement, about 40 % with it or with
/// strokes (overlaps count twice), a factor of about four where patches are so narrow that cells
/// have to be cut. Without memory for any edge length (infinite for the absurd), in milliseconds.
/// @throws ModelingError as validate() and checkRegion()
double estimateNodeCount(const Solid& solid, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});
double estimateNodeCount(const MeshBody& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});
double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});

MeshQuality measureQuality(const SurfaceMesh& mesh);

}  // namespace palpa::modeling
