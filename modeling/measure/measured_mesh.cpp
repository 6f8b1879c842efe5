#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "base/box_tree.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/error.h"
#include "modeling/measure/measured_surface.h"
#include "modeling/measure/mesh_edges.h"
#include "modeling/measure/vertex_fit.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Fit = MeasuredValue::Fit;
using What = MeasuredPlace::What;

/// A stored position farther from its face than this part of the body's size is gone.
constexpr double kGone = 1e-4;
/// A shape fits vertices if it misses them by less than this part of the height of their surface.
constexpr double kFits = 2e-3;
constexpr double kFlat = 1e-7;    // of the size: height of a plane's vertices
constexpr int kJetPoints = 28;    // for a polynomial of degree 4, which has 15 coefficients
constexpr int kCirclePoints = 7;  // around a point of an edge that is no circle

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

class MeasuredMesh : public MeasuredSurface {
 public:
  explicit MeasuredMesh(const MeshBody& body)
      : body_(body), neighbours_(triangleNeighbours(body.triangles())), edges_(body_, neighbours_) {
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
      normals_.push_back((p[n[1]] - p[n[0]]).cross(p[n[2]] - p[n[0]]));
    }
  }

  double size() const override { return size_; }

  PlacePoint at(const MeasuredPlace& place) const override {
    const int face = faceOf(place);
    if (place.what == MeasuredPlace::What::kEdge) {
      const MeshEdge chain = edgeOf(place);
      return {chain.position, faceNormal(face, chain.position)};
    }
    const Vector3d& stored = std::get<Vector3d>(place.at);
    const Vector3d found = nearestOnFace(face, stored);
    if ((found - stored).norm() > kGone * size_)
      throw ModelingError("face \"" + place.patch +
                          "\": the body has no such place any more; measure again");
    return {found, faceNormal(face, found)};
  }

  EdgeLine edge(const MeasuredPlace& place) const override {
    EdgeLine line;
    line.points = edgeOf(place).points;
    for (std::size_t i = 1; i < line.points.size(); ++i)
      line.length += (line.points[i] - line.points[i - 1]).norm();
    line.chainLength = line.length;
    line.accuracy = 1e-12 * line.length;
    return line;
  }

  /// The circle through the whole edge, or else through the vertices around the place.
  EdgePoint edgeAt(const MeasuredPlace& place) const override {
    const MeshEdge chain = edgeOf(place);
    EdgePoint point{chain.position,
                    (chain.points[chain.segment + 1] - chain.points[chain.segment]).normalized()};
    const auto set = [&](const std::vector<Vector3d>& points, double allowed) {
      const auto circle = fitCircle(points);
      if (!circle || circle->deviation > allowed) return false;
      const Vector3d radial = circle->centre - chain.position;
      point.curvature = radial.normalized() / circle->radius;
      point.tangent = circle->axis.cross(radial).normalized();
      point.accuracy = circle->deviation + 1e-12 * circle->radius;
      point.fit = Fit::kCircle;
      return true;
    };
    if (isStraight(chain.points)) return point;
    std::vector<Vector3d> all = chain.points;
    if (all.front() == all.back()) all.pop_back();
    if (set(all, kFits * heightOf(all))) return point;
    std::vector<Vector3d> near;
    const int count = static_cast<int>(all.size());
    const bool isClosed = all.size() < chain.points.size();
    for (int k = 0; k < std::min(kCirclePoints, count); ++k) {
      int i = static_cast<int>(chain.segment) - kCirclePoints / 2 + 1 + k;
      if (isClosed) i = (i + count) % count;
      if (i >= 0 && i < count) near.push_back(all[i]);
    }
    if (near.size() < 3 || isStraight(near) || !set(near, std::numeric_limits<double>::infinity()))
      return point;
    // Twice as far along the edge, a curve that is no circle has another curvature.
    std::vector<Vector3d> nearer(near.begin() + 1, near.end() - (near.size() > 4 ? 1 : 0));
    const double radius = 1 / point.curvature.norm();
    if (const auto circle = fitCircle(nearer)) point.accuracy += std::abs(circle->radius - radius);
    return point;
  }

  /// A plane, a sphere or a cylinder through the vertices of the smooth surface around the place,
  /// or else a polynomial through the vertices next to it.
  Curvatures curvatures(const MeasuredPlace& place) const override {
    const PlacePoint at = this->at(place);
    const std::vector<int> region = smoothAround(triangleAt(faceOf(place), at.position));
    std::vector<Vector3d> points, normals;
    std::set<int> vertices;
    for (const int t : region) {
      normals.push_back(normals_[t]);
      for (const int v : body_.triangles()[t])
        if (vertices.insert(v).second) points.push_back(body_.positions()[v]);
    }
    const double height = flatDeviation(points);
    if (height < kFlat * size_) return {};
    if (const auto sphere = fitSphere(points); sphere && sphere->deviation < kFits * height)
      return curved(*sphere, at, true);
    if (const auto cylinder = fitCylinder(points, normals);
        cylinder && cylinder->deviation < kFits * height)
      return curved(*cylinder, at, false);
    return fitted(at, points, place.patch);
  }

  Vector3d nearestOn(const MeasuredPlace& place, const Vector3d& x) const override {
    switch (place.what) {
      case MeasuredPlace::What::kFace:
        return nearestOnFace(faceOf(place), x);
      case MeasuredPlace::What::kEdge:
        return nearestOnLine(edgeOf(place).points, x);
      case MeasuredPlace::What::kPoint:
        break;
    }
    return at(place).position;
  }

  std::vector<Vector3d> samples(const MeasuredPlace& place) const override {
    if (place.what == MeasuredPlace::What::kPoint) return {at(place).position};
    if (place.what == MeasuredPlace::What::kEdge) {
      std::vector<Vector3d> points = edgeOf(place).points;
      for (std::size_t i = points.size() - 1; i > 0; --i)
        points.push_back(0.5 * (points[i] + points[i - 1]));
      return points;
    }
    std::vector<Vector3d> points;
    std::set<int> seen;
    for (const int t : trianglesOf_[faceOf(place)]) {
      const auto& [a, b, c] = body_.triangles()[t];
      const auto& p = body_.positions();
      points.push_back((p[a] + p[b] + p[c]) / 3.0);
      for (const int v : {a, b, c})
        if (seen.insert(v).second) points.push_back(p[v]);
    }
    return points;
  }

  Vector3d nearest(const Vector3d& x) const override {
    Vector3d best = Vector3d::Zero();
    double least = std::numeric_limits<double>::infinity();
    tree_.visitNear(x, least, [&](int t, double) { return look(t, x, least, best); });
    return best;
  }

  std::optional<double> firstHit(const Vector3d& origin, const Vector3d& direction,
                                 double least) const override {
    double reach = 4 * size_ + (origin - body_.positions().front()).norm();
    bool isFound = false;
    const auto& p = body_.positions();
    // Möller and Trumbore's intersection, with a margin at the edges so that no ray slips through.
    tree_.visitAlong(origin, direction, reach, [&](int t, double) {
      const auto& n = body_.triangles()[t];
      const Vector3d e = p[n[1]] - p[n[0]], f = p[n[2]] - p[n[0]];
      const Vector3d h = direction.cross(f);
      const double determinant = e.dot(h);
      if (std::abs(determinant) <= 1e-14 * normals_[t].norm()) return reach;
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

  double facetHeight(const MeasuredPlace& place) const override {
    double height = 0;
    const std::vector<int> region = smoothAround(triangleAt(faceOf(place), at(place).position));
    const auto& p = body_.positions();
    for (const int t : region)
      for (int k = 0; k < 3; ++k) {
        const int other = neighbours_[t][k];
        const Vector3d &a = normals_[t], &b = normals_[other];
        const double turn = std::atan2(a.cross(b).norm(), a.dot(b));
        if (turn > kSharpAngle * std::numbers::pi / 180.0) continue;
        // The smaller width of the two triangles across their edge.
        const auto& n = body_.triangles()[t];
        const double length = (p[n[(k + 1) % 3]] - p[n[k]]).norm();
        height = std::max(height, 0.25 * turn * std::min(a.norm(), b.norm()) / length);
      }
    return height;
  }

  MeasuredPlace placeNear(int patch, const Vector3d& x) const override {
    return {MeasuredPlace::What::kPoint, body_.faceNames()[patch], nearestOnFace(patch, x)};
  }

  std::optional<MeasuredPlace> edgeNear(int patch, const Vector3d& x) const override {
    const auto near = edges_.nearest(patch, x);
    if (!near) return std::nullopt;
    return MeasuredPlace{
        What::kEdge, body_.faceNames()[patch], near->position, {}, body_.faceNames()[near->other]};
  }

 private:
  int faceOf(const MeasuredPlace& place) const {
    if (const auto face = body_.findFace(place.patch);
        face && std::holds_alternative<Vector3d>(place.at))
      return *face;
    throw ModelingError("face \"" + place.patch +
                        "\": the body has no such face any more; measure again");
  }

  double look(int t, const Vector3d& x, double& least, Vector3d& best) const {
    const auto& [a, b, c] = body_.triangles()[t];
    const auto& p = body_.positions();
    const Vector3d found = nearestOnTriangle(p[a], p[b], p[c], x);
    const double distance = (found - x).norm();
    if (distance < least) {
      least = distance;
      best = found;
    }
    return least;
  }

  Vector3d nearestOnFace(int face, const Vector3d& x) const {
    Vector3d best = Vector3d::Zero();
    double least = std::numeric_limits<double>::infinity();
    faceTrees_[face].visitNear(
        x, least, [&](int k, double) { return look(trianglesOf_[face][k], x, least, best); });
    return best;
  }

  static Vector3d nearestOnLine(const std::vector<Vector3d>& line, const Vector3d& x) {
    Vector3d best = line.front();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vector3d found = nearestOnSegment(line[i - 1], line[i], x);
      if ((found - x).norm() < (best - x).norm()) best = found;
    }
    return best;
  }

  int triangleAt(int face, const Vector3d& x) const {
    int best = trianglesOf_[face].front();
    double least = std::numeric_limits<double>::infinity();
    faceTrees_[face].visitNear(x, least, [&](int k, double) {
      Vector3d unused;
      const double before = least;
      look(trianglesOf_[face][k], x, least, unused);
      if (least < before) best = trianglesOf_[face][k];
      return least;
    });
    return best;
  }

  /// Normal of the curved surface that the triangles approximate: interpolated between the corners,
  /// where it is the mean, by angle, of the triangles of the face without a sharp edge between
  /// them.
  Vector3d faceNormal(int face, const Vector3d& x) const {
    const int triangle = triangleAt(face, x);
    const auto& n = body_.triangles()[triangle];
    const auto& p = body_.positions();
    const Vector3d own = normals_[triangle].normalized();
    const double cosine = std::cos(kSharpAngle * std::numbers::pi / 180.0);
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = p[n[k]], &b = p[n[(k + 1) % 3]], &c = p[n[(k + 2) % 3]];
      const double weight = (b - x).cross(c - x).dot(own);
      Vector3d corner = Vector3d::Zero();
      for (int i = firstAt_[n[k]]; i < firstAt_[n[k] + 1]; ++i) {
        const int t = trianglesAt_[i];
        if (body_.faceOfTriangle()[t] != face || normals_[t].norm() == 0 ||
            own.dot(normals_[t].normalized()) < cosine)
          continue;
        const auto& m = body_.triangles()[t];
        const int at = m[0] == n[k] ? 0 : m[1] == n[k] ? 1 : 2;
        const Vector3d u = p[m[(at + 1) % 3]] - a, v = p[m[(at + 2) % 3]] - a;
        corner += std::atan2(u.cross(v).norm(), u.dot(v)) * normals_[t].normalized();
      }
      if (corner.norm() > 0) sum += std::max(weight, 0.0) * corner.normalized();
    }
    return sum.norm() > 0 ? Vector3d(sum.normalized()) : own;
  }

  MeshEdge edgeOf(const MeasuredPlace& place) const {
    const int face = faceOf(place);
    const auto other = body_.findFace(place.other);
    if (other)
      if (auto edge = edges_.at(face, *other, std::get<Vector3d>(place.at), kGone * size_))
        return std::move(*edge);
    throw ModelingError("edge between \"" + place.patch + "\" and \"" + place.other +
                        "\": the body has no such edge any more; measure again");
  }

  bool isStraight(const std::vector<Vector3d>& line) const {
    return line.size() < 3 || heightOf(line) < kFlat * size_;
  }

  /// Triangles of the same face that no sharp edge separates from the first.
  std::vector<int> smoothAround(int first) const {
    const double cosine = std::cos(kSharpAngle * std::numbers::pi / 180.0);
    std::vector<int> found{first};
    std::set<int> seen{first};
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const int other : neighbours_[found[i]]) {
        const Vector3d &a = normals_[found[i]], &b = normals_[other];
        const bool isSmooth = body_.faceOfTriangle()[other] == body_.faceOfTriangle()[first] &&
                              a.dot(b) > cosine * a.norm() * b.norm();
        if (isSmooth && seen.insert(other).second) found.push_back(other);
      }
    return found;
  }

  static Curvatures curved(const RoundFit& fit, const PlacePoint& at, bool isSphere) {
    const double sign =
        at.normal.dot(at.position - fit.centre) -
                    at.normal.dot(fit.axis) * fit.axis.dot(at.position - fit.centre) >
                0
            ? 1
            : -1;
    const double curvature = sign / fit.radius;
    return {curvature, isSphere ? curvature : 0, fit.deviation + 1e-12 * fit.radius,
            isSphere ? Fit::kSphere : Fit::kCylinder};
  }

  /// Degree 4 through the nearest vertices; the error is the difference to degree 3.
  static Curvatures fitted(const PlacePoint& at, std::vector<Vector3d> points,
                           const std::string& face) {
    std::sort(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
      return (a - at.position).squaredNorm() < (b - at.position).squaredNorm();
    });
    if (points.size() > kJetPoints) points.resize(kJetPoints);
    const auto fine = jetCurvatures(points, at.normal, 4);
    if (points.size() > kJetPoints / 2) points.resize(kJetPoints / 2);
    const auto coarse = jetCurvatures(points, at.normal, fine ? 3 : 2);
    const auto& best = fine ? fine : coarse;
    if (!best)
      throw ModelingError("face \"" + face +
                          "\": it has too few triangles here for a radius; measure on its edge");
    const double difference =
        coarse && fine ? std::abs((*coarse)[0] - (*fine)[0]) : std::abs((*best)[0]);
    return {(*best)[0], (*best)[1], difference / ((*best)[0] * (*best)[0]), Fit::kPolynomial};
  }

  MeshBody body_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Vector3d> normals_;           // twice the area long
  std::vector<int> firstAt_, trianglesAt_;  // triangles around each vertex, one after another
  std::vector<std::vector<int>> trianglesOf_;
  std::vector<BoxTree> faceTrees_;
  MeshEdges edges_;
  BoxTree tree_;
  double size_ = 0;
};

}  // namespace

std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const MeshBody& body) {
  return std::make_shared<MeasuredMesh>(body);
}

}  // namespace palpa::modeling
