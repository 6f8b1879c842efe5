#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modeling/solid/edge_curve.h"
#include "modeling/solid/solid.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Node of an unfinished mesh with its parameters in every patch it belongs to: one pair inside a
/// patch, two on an edge, two or more in a corner (two where a single side of a body meets a single
/// cap, as at the rim of a cone).
struct WorkNode {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<SurfaceParameter> at;
  int edge = -1;            ///< edge of the solid; -1 inside a patch or in a corner
  double edgeFraction = 0;  ///< on this edge, 0 … 1 of the parameter of uses[0]

  bool isCorner() const { return edge < 0 && at.size() > 1; }
};

struct WorkTriangle {
  std::array<int, 3> nodes;
  int patch;
  std::uint64_t sides = 0;  ///< bit k: the triangle lies inside border k of the mesh
};

/// Unfinished mesh: triangles over the patches of a solid, with the topology that edits need (the
/// allowed motion of a node, the surface points between two nodes). `solid` and `surface` must
/// outlive it.
struct WorkMesh {
  const Solid* solid = nullptr;
  const SurfaceEvaluator* surface = nullptr;
  std::vector<WorkNode> nodes;
  std::vector<WorkTriangle> triangles;

  /// Parameters of a node in one of its patches.
  const SurfaceParameter& in(int node, int patch) const;

  /// The edge of the solid under the mesh edge a–b; -1 if it runs inside a patch.
  int edgeBetween(int a, int b) const;

  /// A node on the mesh edge a–b at the fraction s from a to b: on the edge of the solid if the
  /// mesh edge lies on one, otherwise on the straight parameter line in the patch. It is not yet in
  /// the mesh.
  WorkNode between(int a, int b, int patch, double s) const;

  WorkNode nodeInPatch(const SurfaceParameter& at) const;
  WorkNode nodeOnEdge(int edge, double fraction) const;
  WorkNode nodeInCorner(int vertex) const;
};

}  // namespace palpa::modeling
