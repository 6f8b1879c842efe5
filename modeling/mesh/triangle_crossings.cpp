#include "modeling/mesh/triangle_crossings.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "base/box_tree.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vector3d, 3>;

constexpr double kClear = 1e-12;  // of the size: larger distances exceed rounding errors

Kernel::Point_3 exact(const Vector3d& x) {
  return {x.x(), x.y(), x.z()};
}

Kernel::Triangle_3 exact(const Corners& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

CGAL::Orientation side(const Corners& t, const Vector3d& x) {
  return CGAL::orientation(exact(t[0]), exact(t[1]), exact(t[2]), exact(x));
}

/// True if an axis separates the triangles by more than rounding: a normal, a product of two edges,
/// or, for triangles in one plane, the normal of an edge in the plane.
bool clearlyApart(const Corners& a, const Corners& b) {
  const double size = (a[1] - a[0]).cwiseAbs().sum() + (a[2] - a[0]).cwiseAbs().sum() +
                      (b[1] - b[0]).cwiseAbs().sum() + (b[2] - b[0]).cwiseAbs().sum() +
                      a[0].cwiseAbs().sum();
  const auto apartOn = [&](const Vector3d& axis) {
    const std::array<double, 3> p{0.0, axis.dot(a[1] - a[0]), axis.dot(a[2] - a[0])};
    const std::array<double, 3> q{axis.dot(b[0] - a[0]), axis.dot(b[1] - a[0]),
                                  axis.dot(b[2] - a[0])};
    const double gap =
        std::max(*std::min_element(q.begin(), q.end()) - *std::max_element(p.begin(), p.end()),
                 *std::min_element(p.begin(), p.end()) - *std::max_element(q.begin(), q.end()));
    return gap > kClear * size * axis.norm();
  };
  const Vector3d m = (a[1] - a[0]).cross(a[2] - a[0]);
  const Vector3d n = (b[1] - b[0]).cross(b[2] - b[0]);
  if (apartOn(m) || apartOn(n)) return true;
  for (int k = 0; k < 3; ++k) {
    const Vector3d e = a[(k + 1) % 3] - a[k];
    const Vector3d f = b[(k + 1) % 3] - b[k];
    if (apartOn(m.cross(e)) || apartOn(n.cross(f))) return true;
    for (int l = 0; l < 3; ++l)
      if (apartOn(e.cross(b[(l + 1) % 3] - b[l]))) return true;
  }
  return false;
}

/// The point at which the segment p–q passes strictly from one side of the triangle's plane to the
/// other, strictly inside the triangle.
std::optional<Vector3d> throughInside(const Vector3d& p, const Vector3d& q, const Corners& t) {
  const CGAL::Orientation atP = side(t, p);
  const CGAL::Orientation atQ = side(t, q);
  if (atP == CGAL::COPLANAR || atQ == CGAL::COPLANAR || atP == atQ) return std::nullopt;
  const auto turn = [&](int k) {
    return CGAL::orientation(exact(p), exact(q), exact(t[k]), exact(t[(k + 1) % 3]));
  };
  if (turn(0) == CGAL::COPLANAR || turn(0) != turn(1) || turn(1) != turn(2)) return std::nullopt;
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double a = normal.dot(p - t[0]);
  const double b = normal.dot(q - t[0]);
  const double s = a != b ? std::clamp(a / (a - b), 0.0, 1.0) : 0.5;
  return Vector3d(p + s * (q - p));
}

/// The first point at which an edge of one triangle passes through the inside of the other.
std::optional<Vector3d> passage(const Corners& a, const Corners& b) {
  for (int k = 0; k < 3; ++k) {
    if (const auto at = throughInside(a[k], a[(k + 1) % 3], b)) return at;
    if (const auto at = throughInside(b[k], b[(k + 1) % 3], a)) return at;
  }
  return std::nullopt;
}

/// Crossing of two triangles, both of which begin with their common vertices in the same order.
std::optional<TriangleCrossing> crossing(const Corners& a, const Corners& b, int common) {
  const Vector3d middle = (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / 6.0;
  const auto found = [&](bool isThrough, const Vector3d& at) {
    return TriangleCrossing{-1, -1, isThrough, at};
  };
  if (common == 3) return found(true, middle);
  if (common == 2) {
    // Half planes with a common boundary line have other common points only if they are equal.
    const Vector3d edge = a[1] - a[0];
    const Vector3d m = edge.cross(a[2] - a[0]);
    const Vector3d n = edge.cross(b[2] - b[0]);
    if (m.dot(n) < -kClear * m.norm() * n.norm()) return std::nullopt;  // clearly on other sides
    if (side(a, b[2]) != CGAL::COPLANAR) return std::nullopt;
    const bool sameSide = CGAL::coplanar_orientation(exact(a[0]), exact(a[1]), exact(a[2]),
                                                     exact(b[2])) == CGAL::POSITIVE;
    return sameSide ? std::optional(found(true, middle)) : std::nullopt;
  }
  if (common == 1) {
    const Kernel::Segment_3 p(exact(a[1]), exact(a[2]));
    const Kernel::Segment_3 q(exact(b[1]), exact(b[2]));
    if (!CGAL::do_intersect(p, exact(b)) && !CGAL::do_intersect(q, exact(a))) return std::nullopt;
  } else {
    if (clearlyApart(a, b) || !CGAL::do_intersect(exact(a), exact(b))) return std::nullopt;
  }
  if (const auto at = passage(a, b)) return found(true, *at);
  return found(false, middle);
}

/// True if a plane through the common vertex separates the triangles by more than rounding.
bool clearlyApartAt(const Corners& a, const Corners& b) {
  const Vector3d p = (a[1] - a[0]).normalized();
  const Vector3d q = (a[2] - a[0]).normalized();
  const Vector3d r = (b[1] - b[0]).normalized();
  const Vector3d s = (b[2] - b[0]).normalized();
  const Vector3d axis = (r + s).normalized() - (p + q).normalized();
  return std::max(axis.dot(p), axis.dot(q)) < -kClear &&
         std::min(axis.dot(r), axis.dot(s)) > kClear;
}

}  // namespace

std::vector<TriangleCrossing> triangleCrossings(const std::vector<Vector3d>& positions,
                                                const std::vector<std::array<int, 3>>& triangles,
                                                std::size_t most, const Job& job) {
  constexpr int kCheckpoint = 4096;  // pairs between checks of the stop token
  std::vector<TriangleCrossing> result;
  int visited = 0;
  const std::vector<BoxTree::Box> boxes = triangleBoxes(positions, triangles);
  triangleTree(positions, triangles, boxes).visitOverlaps(boxes, [&](int a, int b) {
    if (++visited % kCheckpoint == 0) job.throwIfCancelled();
    std::array<int, 3> m = triangles[a];
    std::array<int, 3> n = triangles[b];
    int common = 0;
    for (int i = common; i < 3; ++i)
      for (int j = common; j < 3; ++j)
        if (m[i] == n[j]) {
          std::swap(m[i], m[common]);
          std::swap(n[j], n[common]);
          ++common;
          break;
        }
    const Corners p{positions[m[0]], positions[m[1]], positions[m[2]]};
    const Corners q{positions[n[0]], positions[n[1]], positions[n[2]]};
    if (common == 1 && clearlyApartAt(p, q)) return true;
    if (auto found = crossing(p, q, common)) {
      found->a = a;
      found->b = b;
      result.push_back(*found);
    }
    return result.size() < most;
  });
  std::sort(result.begin(), result.end(),
            [](const auto& x, const auto& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  return result;
}

}  // namespace palpa::modeling
