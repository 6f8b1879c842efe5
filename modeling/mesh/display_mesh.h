#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

// The surface for drawing and touching: finer than the boundary mesh, on the true spline surface,
// and linked to the nodes of the boundary mesh, so that nodal values can be interpolated.
namespace palpa::modeling {

/// Number of pieces per edge of the boundary mesh: the smallest number in the given range for which
/// each piece turns by at most `pieceAngle`. If both ends of the range are equal, the number is
/// fixed.
struct DisplaySettings {
  int leastPieces = 2;                          ///< 1 … 8
  int mostPieces = 8;                           ///< leastPieces … 8
  double pieceAngle = std::numbers::pi / 45.0;  ///< rad, > 0

  /// Throws std::invalid_argument that names the field.
  void validate() const;
};

/// Triangle mesh with normals, closed like the boundary mesh, but with vertices split at sharp
/// edges: a vertex belongs to one smoothing group and has one normal. Split vertices have
/// bit-identical positions.
struct DisplayMesh {
  /// Position of a vertex in the boundary mesh: a nodal field has the value
  /// Σ weights[k] · value(corner k of triangle) here. The triangle belongs to the smoothing group
  /// of the vertex; weights are ≥ 0 with sum 1.
  struct Link {
    int triangle = -1;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  };

  std::vector<Eigen::Vector3d> positions;     ///< mm; at boundary nodes bit-identical to the nodes
  std::vector<Eigen::Vector3d> normals;       ///< unit, outwards
  std::vector<Link> links;                    ///< per vertex
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<int> boundaryTriangle;  ///< per triangle: the boundary triangle it divides; ascending
  std::vector<int> patchOfTriangle;
  std::vector<std::array<int, 2>> edgeLines;  ///< edges of the boundary mesh, piece by piece
};

/// Divides the boundary mesh into the display mesh. `mesh` must be a mesh of `body`.
///
/// Pieces of an edge between two patches lie on the common edge of the patches; pieces of an edge
/// inside a patch lie on the straight line in its parameters. The triangles of a mesh without
/// parameters (mesh body) are divided in their planes, with normals interpolated between the nodes.
///
/// Cost: about 3 µs per vertex. Throws std::invalid_argument as validate(); Cancelled.
DisplayMesh displayMesh(const SurfaceMesh& mesh, const Body& body,
                        const DisplaySettings& settings = {}, const Job& job = {});

}  // namespace palpa::modeling
