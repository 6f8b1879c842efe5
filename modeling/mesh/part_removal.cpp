#include "modeling/mesh/part_removal.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Loop = std::vector<int>;
using Triangle = std::array<int, 3>;

constexpr int kEnd = -1;

/// Triangles that close the surface where a part with that chain was; none if they cannot.
std::vector<Triangle> flatEnd(const std::vector<Vector3d>& positions, const Loop& loop) {
  std::vector<Kernel::Point_3> points;
  for (const int vertex : loop) {
    const Vector3d& p = positions[vertex];
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(found));
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : found) triangles.push_back({loop[a], loop[b], loop[c]});
  // The end runs along the chain in the direction of the part.
  const auto runs = [&](int from, int to) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
      for (int k = 0; k < 3; ++k)
        if (t[k] == from && t[(k + 1) % 3] == to) return true;
      return false;
    });
  };
  if (!runs(loop[0], loop[1]))
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

}  // namespace

PartRemoval::PartRemoval(const FacedTriangles& surface, const std::set<int>& keptFaces)
    : surface_(surface), keptFaces_(keptFaces), isGone_(surface.triangles.size(), false) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      triangleAt_[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] =
          static_cast<int>(t);
}

bool PartRemoval::remove(const SurfacePart& part) {
  std::vector<Triangle> ends;
  std::vector<int> faces;
  for (const std::vector<int>& loop : part.loops) {
    const std::vector<Triangle> end = flatEnd(surface_.positions, loop);
    if (end.size() + 2 != loop.size()) return false;
    ends.insert(ends.end(), end.begin(), end.end());
    faces.insert(faces.end(), end.size(), faceAround(loop));
  }
  const std::set<int> own(part.triangles.begin(), part.triangles.end());
  for (const Triangle& t : ends)
    for (int k = 0; k < 3; ++k) {
      const auto known = triangleAt_.find({t[k], t[(k + 1) % 3]});
      if (known != triangleAt_.end() && !own.contains(known->second)) return false;
    }
  for (const int t : part.triangles) {
    isGone_[t] = true;
    for (int k = 0; k < 3; ++k)
      triangleAt_.erase({surface_.triangles[t][k], surface_.triangles[t][(k + 1) % 3]});
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (int k = 0; k < 3; ++k) triangleAt_[{ends[i][k], ends[i][(k + 1) % 3]}] = kEnd;
    ends_.push_back(ends[i]);
    facesOfEnds_.push_back(faces[i]);
  }
  return true;
}

FacedTriangles PartRemoval::result() const {
  FacedTriangles left;
  std::vector<int> number(surface_.positions.size(), -1);
  const auto add = [&](const Triangle& triangle, int face) {
    Triangle numbered{};
    for (int k = 0; k < 3; ++k) {
      int& vertex = number[triangle[k]];
      if (vertex < 0) {
        vertex = static_cast<int>(left.positions.size());
        left.positions.push_back(surface_.positions[triangle[k]]);
      }
      numbered[k] = vertex;
    }
    left.triangles.push_back(numbered);
    left.faceOfTriangle.push_back(face);
  };
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
    if (!isGone_[t]) add(surface_.triangles[t], surface_.faceOfTriangle[t]);
  for (std::size_t i = 0; i < ends_.size(); ++i) add(ends_[i], facesOfEnds_[i]);
  return left;
}

/// The face with the longest edges at the outside of a chain, or inside if that one is kept.
int PartRemoval::faceAround(const std::vector<int>& loop) const {
  std::map<int, double> outside, inside;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int a = loop[i], b = loop[(i + 1) % loop.size()];
    const double length = (surface_.positions[b] - surface_.positions[a]).norm();
    outside[faceAt(b, a)] += length;
    inside[faceAt(a, b)] += length;
  }
  const auto longest = [](const std::map<int, double>& lengths) {
    return std::max_element(
               lengths.begin(), lengths.end(),
               [](const auto& one, const auto& other) { return one.second < other.second; })
        ->first;
  };
  const int around = longest(outside);
  return keptFaces_.contains(around) ? longest(inside) : around;
}

int PartRemoval::faceAt(int from, int to) const {
  const auto known = triangleAt_.find({from, to});
  return known != triangleAt_.end() && known->second >= 0 ? surface_.faceOfTriangle[known->second]
                                                          : surface_.faceOfTriangle.front();
}

}  // namespace palpa::modeling
