#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <optional>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/closed_surface.h"

namespace palpa::modeling {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;
using GroupMap = Mesh::Property_map<Face, int>;

Eigen::Vector3d centre(const Mesh& mesh, Face face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
    const Kernel::Point_3& p = mesh.point(vertex);
    sum += Eigen::Vector3d(p.x(), p.y(), p.z());
  }
  return sum / 3.0;
}

Mesh toMesh(const ClosedSurface& surface, GroupMap& groups) {
  Mesh mesh;
  for (const Eigen::Vector3d& p : surface.positions) mesh.add_vertex({p.x(), p.y(), p.z()});
  groups = mesh.add_property_map<Face, int>("f:group", -1).first;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto vertex = [&](int k) {
      return Mesh::Vertex_index(static_cast<Mesh::size_type>(surface.triangles[t][k]));
    };
    const Face face = mesh.add_face(vertex(0), vertex(1), vertex(2));
    if (face == Mesh::null_face())
      throw ModelingError("parts of the surface touch near " +
                          placeText(surface.positions[surface.triangles[t][0]]) +
                          "; separate them or join them along a face");
    groups[face] = surface.groups.empty() ? 0 : surface.groups[t];
  }
  return mesh;
}

ClosedSurface fromMesh(const Mesh& mesh, const GroupMap& groups, bool hasGroups) {
  ClosedSurface surface;
  std::vector<int> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto vertex : mesh.vertices()) {
    number[vertex] = static_cast<int>(surface.positions.size());
    const Kernel::Point_3& p = mesh.point(vertex);
    surface.positions.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Face face : mesh.faces()) {
    std::array<int, 3> triangle{};
    int k = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle[k++] = number[vertex];
    surface.triangles.push_back(triangle);
    if (hasGroups) surface.groups.push_back(groups[face]);
  }
  return surface;
}

/// Assigns the new faces with which the repair fills small holes to the group of their neighbours.
void fillGroups(const Mesh& mesh, GroupMap& groups) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face face : mesh.faces()) {
      if (groups[face] >= 0) continue;
      for (const auto edge : mesh.halfedges_around_face(mesh.halfedge(face))) {
        const Face other = mesh.face(mesh.opposite(edge));
        if (other == Mesh::null_face() || groups[other] < 0) continue;
        groups[face] = groups[other];
        changed = true;
        break;
      }
    }
  }
}

void removeFlatTriangles(Mesh& mesh, GroupMap& groups) {
  for (const Face face : mesh.faces())
    if (pmp::is_degenerate_triangle_face(face, mesh)) {
      if (!pmp::remove_degenerate_faces(mesh) || !CGAL::is_closed(mesh))
        throw ModelingError("triangles without area near " + placeText(centre(mesh, face)) +
                            " cannot be removed; repair the surface");
      if (mesh.number_of_faces() == 0)
        throw ModelingError("all triangles are without area; export a closed surface");
      fillGroups(mesh, groups);
      return;
    }
}

struct Found {
  Face one;
  Face other;
};

void refuseSelfIntersection(const Mesh& mesh) {
  // The first pair ends the search, because there may be n² pairs for n triangles.
  struct StopAtFirst {
    StopAtFirst& operator*() { return *this; }
    StopAtFirst& operator++() { return *this; }
    StopAtFirst& operator++(int) { return *this; }
    StopAtFirst& operator=(const std::pair<Face, Face>& pair) {
      throw Found{pair.first, pair.second};
    }
  };
  try {
    pmp::self_intersections(mesh, StopAtFirst());
  } catch (const Found& found) {
    throw ModelingError("the surface intersects or touches itself: the triangles around " +
                        placeText(centre(mesh, found.one)) + " and " +
                        placeText(centre(mesh, found.other)) +
                        " overlap; separate the walls or unite the bodies");
  }
}

/// Orients the normals out of the material: outwards on the outer surfaces, inwards in cavities.
/// Returns the number of bodies and sets the body of each face.
std::size_t orientOutwards(Mesh& mesh, GroupMap& bodies) {
  pmp::orient_to_bound_a_volume(mesh);
  bodies = mesh.add_property_map<Face, int>("f:body", 0).first;
  const auto part = mesh.add_property_map<Face, std::size_t>("f:part", 0).first;
  if (pmp::connected_components(mesh, part) == 1) return 1;
  const auto volume = mesh.add_property_map<Face, std::size_t>("f:volume", 0).first;
  std::vector<int> number(pmp::volume_connected_components(mesh, volume), -1);
  int count = 0;
  for (const Face face : mesh.faces()) {
    int& body = number[volume[face]];
    if (body < 0) body = count++;
    bodies[face] = body;
  }
  return static_cast<std::size_t>(count);
}

}  // namespace

void makeBoundary(ClosedSurface& surface, const Job& job) {
  try {
    GroupMap groups;
    Mesh mesh = toMesh(surface, groups);
    job.throwIfCancelled();
    removeFlatTriangles(mesh, groups);
    job.throwIfCancelled();
    refuseSelfIntersection(mesh);
    job.throwIfCancelled();
    GroupMap bodies;
    const bool hasSeveral = orientOutwards(mesh, bodies) > 1;
    surface = fromMesh(mesh, groups, !surface.groups.empty());
    if (hasSeveral)
      for (const Face face : mesh.faces()) surface.bodies.push_back(bodies[face]);
  } catch (const CGAL::Failure_exception&) {
    throw ModelingError(
        "the surface is too irregular to distinguish inside and outside; repair it");
  }
}

}  // namespace palpa::modeling
