#include "modeling/measure/mesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kSharpTurn = kSharpEdgeDegrees * std::numbers::pi / 180.0;  // rad

/// Nearest point of a triangle (Ericson, Real-Time Collision Detection, section 5.1.5).
Vector3d nearestOnTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                           const Vector3d& x) {
  const Vector3d ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

MeshSurface::MeshSurface(const MeshBody& body)
    : body_(body), neighbours_(triangleNeighbours(body.triangles())) {
  const auto& p = body.positions();
  BoxTree::Box all;
  for (const Vector3d& position : p) all.extend(position);
  size_ = all.diagonal().norm();
  const auto boxes = triangleBoxes(p, body.triangles(), 1e-9);
  tree_ = triangleTree(p, body.triangles(), boxes);
  trianglesOf_.resize(body.faceNames().size());
  for (std::size_t t = 0; t < body.triangles().size(); ++t)
    trianglesOf_[body.faceOfTriangle()[t]].push_back(static_cast<int>(t));
  for (const auto& list : trianglesOf_) {
    std::vector<BoxTree::Box> own;
    std::vector<Vector3d> centres;
    for (const int t : list) {
      own.push_back(boxes[t]);
      centres.push_back(own.back().center());
    }
    faceTrees_.emplace_back(own, centres);
  }
  firstAt_.assign(p.size() + 1, 0);
  for (const auto& triangle : body.triangles())
    for (const int v : triangle) ++firstAt_[v + 1];
  std::partial_sum(firstAt_.begin(), firstAt_.end(), firstAt_.begin());
  trianglesAt_.resize(3 * body.triangles().size());
  std::vector<int> next(firstAt_.begin(), firstAt_.end() - 1);
  for (std::size_t t = 0; t < body.triangles().size(); ++t) {
    const auto& n = body.triangles()[t];
    for (const int v : n) trianglesAt_[next[v]++] = static_cast<int>(t);
    areaNormals_.push_back((p[n[1]] - p[n[0]]).cross(p[n[2]] - p[n[0]]));
  }
}

double MeshSurface::keepNearer(int triangle, const Vector3d& x, double& least,
                               Vector3d& best) const {
  const auto& [a, b, c] = body_.triangles()[triangle];
  const auto& p = body_.positions();
  const Vector3d found = nearestOnTriangle(p[a], p[b], p[c], x);
  const double distance = (found - x).norm();
  if (distance < least) {
    least = distance;
    best = found;
  }
  return least;
}

Vector3d MeshSurface::nearest(const Vector3d& x) const {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  tree_.visitNear(x, least, [&](int t, double) { return keepNearer(t, x, least, best); });
  return best;
}

Vector3d MeshSurface::nearestOnFace(int face, const Vector3d& x) const {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  faceTrees_[face].visitNear(
      x, least, [&](int k, double) { return keepNearer(trianglesOf_[face][k], x, least, best); });
  return best;
}

int MeshSurface::triangleAt(int face, const Vector3d& x) const {
  int best = trianglesOf_[face].front();
  double least = std::numeric_limits<double>::infinity();
  faceTrees_[face].visitNear(x, least, [&](int k, double) {
    Vector3d unused;
    const double before = least;
    keepNearer(trianglesOf_[face][k], x, least, unused);
    if (least < before) best = trianglesOf_[face][k];
    return least;
  });
  return best;
}

std::optional<double> MeshSurface::firstHit(const Vector3d& origin, const Vector3d& direction,
                                            double least) const {
  double reach = 4 * size_ + (origin - body_.positions().front()).norm();
  bool isFound = false;
  const auto& p = body_.positions();
  // Möller and Trumbore's intersection, with a margin at the edges so that no ray slips through.
  tree_.visitAlong(origin, direction, reach, [&](int t, double) {
    const auto& n = body_.triangles()[t];
    const Vector3d e = p[n[1]] - p[n[0]], f = p[n[2]] - p[n[0]];
    const Vector3d h = direction.cross(f);
    const double determinant = e.dot(h);
    if (std::abs(determinant) <= 1e-14 * areaNormals_[t].norm()) return reach;
    const Vector3d from = origin - p[n[0]];
    const double u = from.dot(h) / determinant;
    const Vector3d q = from.cross(e);
    const double v = direction.dot(q) / determinant;
    constexpr double kMargin = 1e-9;
    if (u < -kMargin || v < -kMargin || u + v > 1 + kMargin) return reach;
    const double s = f.dot(q) / determinant;
    if (s > least && s < reach) {
      reach = s;
      isFound = true;
    }
    return reach;
  });
  return isFound ? std::optional(reach) : std::nullopt;
}

Vector3d MeshSurface::normalAt(int face, const Vector3d& x) const {
  const int triangle = triangleAt(face, x);
  const auto& n = body_.triangles()[triangle];
  const auto& p = body_.positions();
  const Vector3d own = areaNormals_[triangle].normalized();
  const double cosine = std::cos(kSharpTurn);
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = p[n[k]], &b = p[n[(k + 1) % 3]], &c = p[n[(k + 2) % 3]];
    const double weight = (b - x).cross(c - x).dot(own);
    Vector3d corner = Vector3d::Zero();
    for (int i = firstAt_[n[k]]; i < firstAt_[n[k] + 1]; ++i) {
      const int t = trianglesAt_[i];
      if (body_.faceOfTriangle()[t] != face || areaNormals_[t].norm() == 0 ||
          own.dot(areaNormals_[t].normalized()) < cosine)
        continue;
      const auto& m = body_.triangles()[t];
      const int at = m[0] == n[k] ? 0 : m[1] == n[k] ? 1 : 2;
      const Vector3d u = p[m[(at + 1) % 3]] - a, v = p[m[(at + 2) % 3]] - a;
      corner += std::atan2(u.cross(v).norm(), u.dot(v)) * areaNormals_[t].normalized();
    }
    if (corner.norm() > 0) sum += std::max(weight, 0.0) * corner.normalized();
  }
  return sum.norm() > 0 ? Vector3d(sum.normalized()) : own;
}

std::vector<int> MeshSurface::smoothAround(int triangle) const {
  const double cosine = std::cos(kSharpTurn);
  std::vector<int> found{triangle};
  std::set<int> seen{triangle};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const int other : neighbours_[found[i]]) {
      const Vector3d &a = areaNormals_[found[i]], &b = areaNormals_[other];
      const bool isSmooth = body_.faceOfTriangle()[other] == body_.faceOfTriangle()[triangle] &&
                            a.dot(b) > cosine * a.norm() * b.norm();
      if (isSmooth && seen.insert(other).second) found.push_back(other);
    }
  return found;
}

double MeshSurface::facetHeight(int triangle) const {
  double height = 0;
  const auto& p = body_.positions();
  for (const int t : smoothAround(triangle))
    for (int k = 0; k < 3; ++k) {
      const int other = neighbours_[t][k];
      const Vector3d &a = areaNormals_[t], &b = areaNormals_[other];
      const double turn = std::atan2(a.cross(b).norm(), a.dot(b));
      if (turn > kSharpTurn) continue;
      // The smaller width of the two triangles across their edge.
      const auto& n = body_.triangles()[t];
      const double length = (p[n[(k + 1) % 3]] - p[n[k]]).norm();
      height = std::max(height, 0.25 * turn * std::min(a.norm(), b.norm()) / length);
    }
  return height;
}

}  // namespace palpa::modeling
