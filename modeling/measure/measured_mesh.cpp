#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "modeling/error.h"
#include "modeling/measure/measured_surface.h"
#include "modeling/measure/mesh_edges.h"
#include "modeling/measure/mesh_surface.h"
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

/// Measurements on the triangles of a mesh body; curvatures by fits through its vertices.
class MeasuredMesh : public MeasuredSurface {
 public:
  explicit MeasuredMesh(const MeshBody& body)
      : surface_(body), edges_(surface_.body(), surface_.neighbours()) {}

  double size() const override { return surface_.size(); }

  PlacePoint at(const MeasuredPlace& place) const override {
    const int face = faceOf(place);
    if (place.what == What::kEdge) {
      const MeshEdge chain = edgeOf(place);
      return {chain.position, surface_.normalAt(face, chain.position)};
    }
    const Vector3d& stored = std::get<Vector3d>(place.at);
    const Vector3d found = surface_.nearestOnFace(face, stored);
    if ((found - stored).norm() > kGone * surface_.size())
      throw ModelingError("face \"" + place.patch +
                          "\": the body has no such place any more; measure again");
    return {found, surface_.normalAt(face, found)};
  }

  EdgeLine edge(const MeasuredPlace& place) const override {
    EdgeLine line;
    line.points = edgeOf(place).points;
    for (std::size_t i = 1; i < line.points.size(); ++i)
      line.length += (line.points[i] - line.points[i - 1]).norm();
    line.chainLength = line.length;
    line.accuracy = kMeasuredRounding * line.length;
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
      point.accuracy = circle->deviation + kMeasuredRounding * circle->radius;
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
    // The error of a curve that is no circle: the difference to the circle through fewer vertices.
    std::vector<Vector3d> nearer(near.begin() + 1, near.end() - (near.size() > 4 ? 1 : 0));
    const double radius = 1 / point.curvature.norm();
    if (const auto circle = fitCircle(nearer)) point.accuracy += std::abs(circle->radius - radius);
    return point;
  }

  /// A plane, a sphere or a cylinder through the vertices of the smooth surface around the place,
  /// or else a polynomial through the vertices next to it.
  Curvatures curvatures(const MeasuredPlace& place) const override {
    const PlacePoint at = this->at(place);
    const std::vector<int> region =
        surface_.smoothAround(surface_.triangleAt(faceOf(place), at.position));
    std::vector<Vector3d> points, normals;
    std::set<int> vertices;
    for (const int t : region) {
      normals.push_back(surface_.areaNormal(t));
      for (const int v : body().triangles()[t])
        if (vertices.insert(v).second) points.push_back(body().positions()[v]);
    }
    const double height = flatDeviation(points);
    if (height < kFlat * surface_.size()) return {};
    if (const auto sphere = fitSphere(points); sphere && sphere->deviation < kFits * height)
      return curved(*sphere, at, true);
    if (const auto cylinder = fitCylinder(points, normals);
        cylinder && cylinder->deviation < kFits * height)
      return curved(*cylinder, at, false);
    return fitted(at, points, place.patch);
  }

  Vector3d nearestOn(const MeasuredPlace& place, const Vector3d& x) const override {
    switch (place.what) {
      case What::kFace:
        return surface_.nearestOnFace(faceOf(place), x);
      case What::kEdge:
        return nearestOnLine(edgeOf(place).points, x);
      case What::kPoint:
        break;
    }
    return at(place).position;
  }

  std::vector<Vector3d> samples(const MeasuredPlace& place) const override {
    if (place.what == What::kPoint) return {at(place).position};
    if (place.what == What::kEdge) {
      std::vector<Vector3d> points = edgeOf(place).points;
      for (std::size_t i = points.size() - 1; i > 0; --i)
        points.push_back(0.5 * (points[i] + points[i - 1]));
      return points;
    }
    std::vector<Vector3d> points;
    std::set<int> seen;
    for (const int t : surface_.trianglesOf(faceOf(place))) {
      const auto& [a, b, c] = body().triangles()[t];
      const auto& p = body().positions();
      points.push_back((p[a] + p[b] + p[c]) / 3.0);
      for (const int v : {a, b, c})
        if (seen.insert(v).second) points.push_back(p[v]);
    }
    return points;
  }

  Vector3d nearest(const Vector3d& x) const override { return surface_.nearest(x); }

  std::optional<double> firstHit(const Vector3d& origin, const Vector3d& direction,
                                 double least) const override {
    return surface_.firstHit(origin, direction, least);
  }

  double facetHeight(const MeasuredPlace& place) const override {
    return surface_.facetHeight(surface_.triangleAt(faceOf(place), at(place).position));
  }

  MeasuredPlace placeNear(int patch, const Vector3d& x) const override {
    return {What::kPoint, body().faceNames()[patch], surface_.nearestOnFace(patch, x)};
  }

  std::optional<MeasuredPlace> edgeNear(int patch, const Vector3d& x) const override {
    const auto near = edges_.nearest(patch, x);
    if (!near) return std::nullopt;
    return MeasuredPlace{What::kEdge,
                         body().faceNames()[patch],
                         near->position,
                         {},
                         body().faceNames()[near->other]};
  }

 private:
  const MeshBody& body() const { return surface_.body(); }

  int faceOf(const MeasuredPlace& place) const {
    if (const auto face = body().findFace(place.patch);
        face && std::holds_alternative<Vector3d>(place.at))
      return *face;
    throw ModelingError("face \"" + place.patch +
                        "\": the body has no such face any more; measure again");
  }

  static Vector3d nearestOnLine(const std::vector<Vector3d>& line, const Vector3d& x) {
    Vector3d best = line.front();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vector3d found = nearestOnSegment(line[i - 1], line[i], x);
      if ((found - x).norm() < (best - x).norm()) best = found;
    }
    return best;
  }

  MeshEdge edgeOf(const MeasuredPlace& place) const {
    const int face = faceOf(place);
    const auto other = body().findFace(place.other);
    if (other)
      if (auto edge =
              edges_.at(face, *other, std::get<Vector3d>(place.at), kGone * surface_.size()))
        return std::move(*edge);
    throw ModelingError("edge between \"" + place.patch + "\" and \"" + place.other +
                        "\": the body has no such edge any more; measure again");
  }

  bool isStraight(const std::vector<Vector3d>& line) const {
    return line.size() < 3 || heightOf(line) < kFlat * surface_.size();
  }

  /// Curvatures of a sphere or a cylinder, positive where `at` is on its outer side.
  static Curvatures curved(const RoundFit& fit, const PlacePoint& at, bool isSphere) {
    const double sign =
        at.normal.dot(at.position - fit.centre) -
                    at.normal.dot(fit.axis) * fit.axis.dot(at.position - fit.centre) >
                0
            ? 1
            : -1;
    const double curvature = sign / fit.radius;
    return {curvature, isSphere ? curvature : 0, fit.deviation + kMeasuredRounding * fit.radius,
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

  MeshSurface surface_;
  MeshEdges edges_;  // of surface_.body()
};

}  // namespace

std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const MeshBody& body) {
  return std::make_shared<MeasuredMesh>(body);
}

}  // namespace palpa::modeling
