#include "modeling/mesh/plane_section.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <limits>
#include <map>

#include "modeling/mesh/section_outline.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Index of a given point of the outline; -1 for points that the refinement inserts.
struct Given {
  int index = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<Given, Kernel,
                                                CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

/// Bound on the triangles' shape: 1 / (4 sin^2) of the least angle, 20.7 degrees.
constexpr double kShape = 0.125;
constexpr int kStepsBetweenChecks = 64;

/// Marks the faces inside an odd number of outlines.
void markInside(Triangulation& triangulation) {
  std::map<Triangulation::Face_handle, int> crossings;
  std::deque<Triangulation::Face_handle> open{triangulation.infinite_face()};
  crossings[open.front()] = 0;
  while (!open.empty()) {
    const auto face = open.front();
    open.pop_front();
    const int here = crossings[face];
    face->set_in_domain(here % 2 == 1 && !triangulation.is_infinite(face));
    for (int k = 0; k < 3; ++k) {
      const auto other = face->neighbor(k);
      const bool isBorder = triangulation.is_constrained({face, k});
      // Across the border only when everything on this side is known: breadth first by crossings.
      if (crossings.contains(other)) continue;
      crossings[other] = here + (isBorder ? 1 : 0);
      if (isBorder)
        open.push_back(other);
      else
        open.push_front(other);
    }
  }
}

/// The loops in the coordinates of the plane, and back.
struct Frame {
  Vector3d origin, x, y;
  explicit Frame(const Plane& plane)
      : origin(plane.offset * plane.normal),
        x(plane.normal.unitOrthogonal()),
        y(plane.normal.cross(x)) {}
  Kernel::Point_2 flat(const Vector3d& at) const {
    return {x.dot(at - origin), y.dot(at - origin)};
  }
  Vector3d inSpace(const Kernel::Point_2& at) const { return origin + at.x() * x + at.y() * y; }
};

PlaneSection::OutlinePoint between(const PlaneSection::OutlinePoint& a,
                                   const PlaneSection::OutlinePoint& b, double t) {
  return {{a.vertices[0], a.vertices[1], b.vertices[0], b.vertices[1]},
          {(1 - t) * a.weights[0], (1 - t) * a.weights[1], t * b.weights[0], t * b.weights[1]}};
}

/// Weights of a point that the refinement inserted into the outline.
PlaneSection::OutlinePoint onOutline(const std::vector<SectionLoop>& loops, const Vector3d& at) {
  double nearest = std::numeric_limits<double>::infinity();
  PlaneSection::OutlinePoint found{};
  for (const SectionLoop& loop : loops)
    for (std::size_t k = 0; k < loop.positions.size(); ++k) {
      const std::size_t next = (k + 1) % loop.positions.size();
      const Vector3d along = loop.positions[next] - loop.positions[k];
      const double length = along.squaredNorm();
      const double t =
          length > 0 ? std::clamp(along.dot(at - loop.positions[k]) / length, 0.0, 1.0) : 0.0;
      const double distance = (loop.positions[k] + t * along - at).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = between(loop.points[k], loop.points[next], t);
    }
  return found;
}

}  // namespace

PlaneSection planeSection(const std::vector<Vector3d>& positions,
                          const std::vector<std::array<int, 3>>& triangles, const Plane& plane,
                          double edgeLength, const Job& job) {
  PlaneSection section;
  const std::vector<SectionLoop> loops = sectionOutline(positions, triangles, plane);
  if (loops.empty()) return section;
  job.throwIfCancelled();

  const Frame frame(plane);
  Triangulation triangulation;
  std::vector<std::pair<std::size_t, std::size_t>> known;  // loop and point of an index
  for (std::size_t l = 0; l < loops.size(); ++l) {
    std::vector<Triangulation::Vertex_handle> handles;
    for (std::size_t k = 0; k < loops[l].positions.size(); ++k) {
      const auto handle = triangulation.insert(frame.flat(loops[l].positions[k]));
      handle->info().index = static_cast<int>(known.size());
      known.emplace_back(l, k);
      handles.push_back(handle);
    }
    for (std::size_t k = 0; k < handles.size(); ++k) {
      const auto& to = handles[(k + 1) % handles.size()];
      if (handles[k] != to) triangulation.insert_constraint(handles[k], to);
    }
  }
  if (triangulation.dimension() < 2) return section;
  const std::size_t given = triangulation.number_of_vertices();
  markInside(triangulation);
  Mesher mesher(triangulation, Criteria(kShape, edgeLength));
  mesher.init(true);
  for (int step = 0; !mesher.is_refinement_done() &&
                     triangulation.number_of_vertices() < given + kMaxSectionPoints;
       ++step) {
    if (step % kStepsBetweenChecks == 0) job.throwIfCancelled();
    mesher.step_by_step_refine_mesh();
  }

  // Outline first.
  std::map<Triangulation::Vertex_handle, int> numbers;
  const auto addOutline = [&](Triangulation::Vertex_handle vertex) {
    const auto [at, isNew] = numbers.emplace(vertex, static_cast<int>(section.positions.size()));
    if (!isNew) return at->second;
    const int index = vertex->info().index;
    if (index >= 0) {
      const auto [l, k] = known[static_cast<std::size_t>(index)];
      section.positions.push_back(loops[l].positions[k]);
      section.outline.push_back(loops[l].points[k]);
    } else {
      section.positions.push_back(frame.inSpace(vertex->point()));
      section.outline.push_back(onOutline(loops, section.positions.back()));
    }
    return at->second;
  };
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    const auto face = edge->first, other = face->neighbor(edge->second);
    if (face->is_in_domain() == other->is_in_domain()) continue;
    const int a = addOutline(face->vertex(triangulation.cw(edge->second))),
              b = addOutline(face->vertex(triangulation.ccw(edge->second)));
    section.edges.push_back({a, b});
  }
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face) {
    if (!face->is_in_domain()) continue;
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto vertex = face->vertex(k);
      const auto [at, isNew] = numbers.emplace(vertex, static_cast<int>(section.positions.size()));
      if (isNew) section.positions.push_back(frame.inSpace(vertex->point()));
      corners[static_cast<std::size_t>(k)] = at->second;
    }
    section.triangles.push_back(corners);
  }
  return section;
}

}  // namespace palpa::modeling
