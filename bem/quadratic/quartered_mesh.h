#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Local coordinates of the six nodes of a quadratic triangle: of the corners, then of the middles
/// of the edges 0-1, 1-2 and 2-0.
inline const std::array<Eigen::Vector2d, 6> kQuadraticNodes{
    Eigen::Vector2d(0, 0),   Eigen::Vector2d(1, 0),     Eigen::Vector2d(0, 1),
    Eigen::Vector2d(0.5, 0), Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(0, 0.5)};

/// Nodes of the quarters of an element: of its corners 0, 1 and 2 and of its middle.
inline constexpr std::array<std::array<int, 3>, 4> kQuarters{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

/// Mesh of six-node triangles in the form of flat triangles between their nodes: triangles 4 e …
/// 4 e + 3 are the quarters of element e, of its corners 0, 1 and 2 and of its middle. With the
/// corners a, b, c and the middles ab, bc, ca of the edges they are (a, ab, ca), (ab, b, bc), (ca,
/// bc, c), (ab, bc, ca). So the nodes of the flat mesh are the nodes of the elements, and its slots
/// their traction coefficients.
///
/// Elements with a vertex on the border of a support or on a notch (supportBorderVertices(), base)
/// have BorderCoordinates, unless `isPlain`. The middle node of an edge from such a vertex to
/// another lies at the fraction kBorderEdgeShare of the edge from this vertex.
///
/// `middle`(triangle, edge, share): position of the middle node of the edge from corner `edge` of a
/// triangle of `corners` to the next, at the fraction `share` of the edge, mm; asked once per edge.
/// The nodes of `corners` keep their indices, the middle nodes follow. `supportTags`: of triangles
/// in supports.
BoundaryMesh quarteredMesh(
    const BoundaryMesh& corners,
    const std::function<Eigen::Vector3d(int triangle, int edge, double share)>& middle,
    const std::vector<int>& supportTags = {}, bool isPlain = false);

/// For each tag: whether it is one of the supports'.
std::vector<bool> areSupported(const std::vector<int>& tags, const std::vector<int>& supportTags);

/// True if the middle node of an edge between two nodes is nearer to one end, which is on the
/// border of a support.
inline bool isBorderEdge(const std::vector<bool>& isBorderVertex, int from, int to) {
  return isBorderVertex[from] != isBorderVertex[to];
}

}  // namespace palpa::bem
