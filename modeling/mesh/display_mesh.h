#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

// The surface as it is drawn and touched: finer than the boundary mesh, on the true spline surface,
// and linked to the nodes, so that whatever is known at nodes can be carried over.
namespace palpa::modeling {

/// Into how many pieces each edge of the boundary mesh is cut: so many that each piece turns by at
/// most `pieceAngle`, within the given range. Equal ends of the range give a fixed number.
struct DisplaySettings {
  int leastPieces = 2;                          ///< 1 … 8
  int mostPieces = 8;                           ///< leastPieces … 8
  double pieceAngle = std::numbers::pi / 45.0;  ///< rad, > 0

  /// @throws std::invalid_argument that names the field
  void validate() const;
};

/// Closed like the boundary mesh, but with vertices split at sharp edges: a vertex belongs to one
/// smoothing group and has one normal. Vertices that were split have equal positions in every bit.
struct DisplayMesh {
  /// Place in the boundary mesh: a value known at its nodes is Σ weights[k] · value(triangle's
  /// corner k) here. The triangle is of the vertex's smoothing group; weights are ≥ 0 with sum 1.
  struct Link {
    int triangle = -1;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  };

  std::vector<Eigen::Vector3d> positions;  ///< mm; at boundary nodes exactly theirs
  std::vector<Eigen::Vector3d> normals;    ///< unit, outwards
  std::vector<Link> links;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<int> boundaryTriangle;          ///< per triangle: the one it is a piece of; ascending
  std::vector<int> patchOfTriangle;
  std::vector<std::array<int, 2>> edgeLines;  ///< the boundary mesh's edges, piece by piece
};

/// Pieces of edges between two patches lie on the common edge of the patches, those inside a patch
/// on the straight line in its parameters. A mesh without parameters (mesh bodies) is cut flat,
/// with normals interpolated between its nodes.
///
/// `mesh` must be a mesh of `body`. Cost: about 3 µs per vertex.
/// @throws std::invalid_argument, Cancelled
DisplayMesh displayMesh(const SurfaceMesh& mesh, const Body& body,
                        const DisplaySettings& settings = {}, const Job& job = {});

}  // namespace palpa::modeling
