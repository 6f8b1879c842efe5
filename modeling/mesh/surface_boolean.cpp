#include "modeling/mesh/surface_boolean.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "modeling/mesh/nearest_point.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
namespace pmp = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

Mesh toMesh(const FacedTriangles& surface) {
  Mesh mesh;
  for (const Vector3d& p : surface.positions) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : surface.triangles)
    mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  return mesh;
}

/// Positions and triangles of a mesh, without faces, in an order that follows from the positions.
/// CGAL's order of what it unites depends on addresses in memory, and with it what later steps make
/// of the surface.
FacedTriangles toTriangles(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Point, Mesh::Vertex_index>> vertices;
  for (const auto vertex : mesh.vertices()) vertices.emplace_back(mesh.point(vertex), vertex);
  std::sort(vertices.begin(), vertices.end());
  FacedTriangles surface;
  std::vector<int> number(mesh.num_vertices(), -1);
  for (const auto& [p, vertex] : vertices) {
    number[vertex] = static_cast<int>(surface.positions.size());
    surface.positions.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto face : mesh.faces()) {
    std::array<int, 3>& corners = surface.triangles.emplace_back();
    int k = 0;
    for (const auto vertex : vertices_around_face(mesh.halfedge(face), mesh))
      corners[k++] = number[vertex];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(surface.triangles.begin(), surface.triangles.end());
  return surface;
}

bool isSolid(const Mesh& mesh, const FacedTriangles& triangles) {
  return mesh.number_of_faces() == triangles.triangles.size() && CGAL::is_closed(mesh) &&
         !pmp::does_self_intersect(mesh) && pmp::is_outward_oriented(mesh);
}

/// `combine`: one of CGAL's functions of both meshes, the result and its options.
template <class Combine>
std::optional<FacedTriangles> combined(const FacedTriangles& body, const FacedTriangles& solid,
                                       Combine combine) {
  Mesh other = toMesh(solid);
  if (!isSolid(other, solid)) return std::nullopt;
  Mesh one = toMesh(body), result;
  try {
    if (!combine(one, other, result, pmp::parameters::throw_on_self_intersection(true)))
      return std::nullopt;
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  return toTriangles(result);
}

}  // namespace

std::optional<FacedTriangles> unionOf(const FacedTriangles& body, const FacedTriangles& solid) {
  return combined(body, solid, [](auto&&... arguments) {
    return pmp::corefine_and_compute_union(arguments...);
  });
}

std::optional<FacedTriangles> differenceOf(const FacedTriangles& body,
                                           const FacedTriangles& solid) {
  return combined(body, solid, [](auto&&... arguments) {
    return pmp::corefine_and_compute_difference(arguments...);
  });
}

bool cutsThroughItself(const FacedTriangles& surface) {
  return pmp::does_self_intersect(toMesh(surface));
}

void takeFaces(FacedTriangles& changed, const FacedTriangles& original) {
  const NearestOnTriangles before(original.positions, original.triangles);
  changed.faceOfTriangle.clear();
  for (const auto& [a, b, c] : changed.triangles)
    changed.faceOfTriangle.push_back(original.faceOfTriangle[before.nearestTriangle(
        (changed.positions[a] + changed.positions[b] + changed.positions[c]) / 3)]);
}

}  // namespace palpa::modeling
