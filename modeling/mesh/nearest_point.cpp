#include "modeling/mesh/nearest_point.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <limits>

namespace palpa::modeling {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Eigen::Vector3d;

Point toPoint(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Vector3d toVector(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

template <class Primitive>
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// Elements and the tree that points to them. Not movable because of the pointers.
template <class Element, class Primitive>
struct ElementTree {
  std::vector<Element> elements;
  AabbTree<Primitive> tree;

  void build() {
    tree.insert(elements.begin(), elements.end());
    // CGAL would do this lazily, and not thread-safely, at the first query.
    tree.build();
    tree.accelerate_distance_queries();
  }
};

using TriangleList = std::vector<Kernel::Triangle_3>;
using SegmentList = std::vector<Kernel::Segment_3>;

std::vector<std::array<Vector3d, 3>> cornersOf(const std::vector<Vector3d>& positions,
                                               const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::array<Vector3d, 3>> corners;
  for (const auto& [a, b, c] : triangles)
    corners.push_back({positions[a], positions[b], positions[c]});
  return corners;
}

}  // namespace

struct NearestOnTriangles::Tree
    : ElementTree<Kernel::Triangle_3,
                  CGAL::AABB_triangle_primitive<Kernel, TriangleList::iterator>> {
  std::vector<int> indices;  ///< per element
};

struct NearestOnSegments::Tree
    : ElementTree<Kernel::Segment_3, CGAL::AABB_segment_primitive<Kernel, SegmentList::iterator>> {
};

NearestOnTriangles::NearestOnTriangles(const std::vector<Vector3d>& positions,
                                       const std::vector<std::array<int, 3>>& triangles)
    : NearestOnTriangles(cornersOf(positions, triangles)) {}

NearestOnTriangles::NearestOnTriangles(const std::vector<std::array<Vector3d, 3>>& triangles) {
  auto tree = std::make_shared<Tree>();
  // CGAL may divide by the area. Neighbours cover the triangles without area.
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if ((b - a).cross(c - a).squaredNorm() == 0.0) continue;
    tree->elements.emplace_back(toPoint(a), toPoint(b), toPoint(c));
    tree->indices.push_back(static_cast<int>(t));
  }
  if (tree->elements.empty()) return;
  tree->build();
  tree_ = std::move(tree);
}

Vector3d NearestOnTriangles::nearest(const Vector3d& point) const {
  return tree_ ? toVector(tree_->tree.closest_point(toPoint(point))) : point;
}

int NearestOnTriangles::nearestTriangle(const Vector3d& point) const {
  if (!tree_) return -1;
  const auto found = tree_->tree.closest_point_and_primitive(toPoint(point)).second;
  return tree_->indices[static_cast<std::size_t>(found - tree_->elements.begin())];
}

double NearestOnTriangles::distanceAlong(const Vector3d& from, const Vector3d& direction,
                                         int skipped) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!tree_) return kNone;
  const auto& indices = tree_->indices;
  const auto& elements = tree_->elements;
  const Kernel::Ray_3 ray(toPoint(from),
                          Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
  const auto hit = tree_->tree.first_intersection(ray, [&](const auto& element) {
    return indices[static_cast<std::size_t>(element - elements.begin())] == skipped;
  });
  if (!hit) return kNone;
  if (const Point* point = boost::get<Point>(&hit->first)) return (toVector(*point) - from).norm();
  return kNone;  // along the triangle
}

NearestOnSegments::NearestOnSegments(const std::vector<std::array<Vector3d, 2>>& segments) {
  auto tree = std::make_shared<Tree>();
  for (const auto& [a, b] : segments)
    if (a != b) tree->elements.emplace_back(toPoint(a), toPoint(b));
  if (tree->elements.empty()) return;
  tree->build();
  tree_ = std::move(tree);
}

Vector3d NearestOnSegments::nearest(const Vector3d& point) const {
  return tree_ ? toVector(tree_->tree.closest_point(toPoint(point))) : point;
}

double NearestOnSegments::distance(const Vector3d& point) const {
  return tree_ ? (nearest(point) - point).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace palpa::modeling
