#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::bench {

/// A body of tetrahedra with 4 or 10 nodes each, whose surface is a given triangle mesh.
///
/// Nodes of a tetrahedron: 4 corners, then the middles of the edges 01, 12, 20, 03, 13, 23. Nodes
/// of a face: 3 corners, then the middles of 01, 12, 20. In linear elements the nodes after
/// the corners are 0.
struct TetrahedralMesh {
  bool isQuadratic = false;
  std::vector<Eigen::Vector3d> nodes;  ///< mm; surface nodes first, then inner nodes
  std::vector<std::array<int, 10>> tetrahedra;
  std::vector<std::array<int, 6>> faces;  ///< as the triangles of the surface
  std::vector<int> tags;                  ///< of the faces: 0 where tractions are given

  int nodeCount() const { return static_cast<int>(nodes.size()); }
  int tetrahedronNodes() const { return isQuadratic ? 10 : 4; }
  int faceNodes() const { return isQuadratic ? 6 : 3; }
  double volume() const;  ///< mm^3, of the tetrahedra with straight edges
};

/// Position of the middle of an edge of the surface, from its ends and the normal of one of its
/// triangles, mm.
using EdgeMiddle = std::function<Eigen::Vector3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 const Eigen::Vector3d& faceNormal)>;

/// Adds nodes in the middles of all edges. Nodes on the surface move to the positions of `middle`,
/// unless a tetrahedron would turn inside out; without `middle` edges stay straight.
TetrahedralMesh makeQuadratic(const TetrahedralMesh& linear, const EdgeMiddle& middle);

/// Values of the functions of a face at barycentric coordinates, faceNodes() of them, and the
/// derivatives by the second and third coordinate.
struct FaceFunctions {
  double value[6], slope[2][6];
  FaceFunctions(bool isQuadratic, const Eigen::Vector3d& barycentric);
};

/// Calls visit(face, functions, position in mm, outward area vector times weight in mm^2) for a
/// rule of degree 8 on each of `pieces`^2 parts of the faces in a list.
void visitFaces(
    const TetrahedralMesh& mesh, std::span<const int> faces, int pieces,
    const std::function<void(int face, const FaceFunctions& functions,
                             const Eigen::Vector3d& position, const Eigen::Vector3d& area)>& visit);

}  // namespace palpa::bench
