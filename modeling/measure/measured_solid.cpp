#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "modeling/error.h"
#include "modeling/measure/measured_surface.h"
#include "modeling/measure/patch_edges.h"
#include "modeling/measure/patch_search.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using What = MeasuredPlace::What;

constexpr int kLinePieces = 24;  // per span, of an edge as a line

/// Measurements on the exact patches of a solid.
class MeasuredSolid : public MeasuredSurface {
 public:
  explicit MeasuredSolid(const Solid& solid)
      : solid_(solid), search_(solid_), edges_(solid_, search_) {}

  double size() const override { return search_.size(); }

  PlacePoint at(const MeasuredPlace& place) const override {
    const PatchPoint point = pointOf(place);
    return {point.position, normal(point)};
  }

  EdgePoint edgeAt(const MeasuredPlace& place) const override {
    const PatchEdge edge = edgeOf(place);
    return edges_.pointAt(edge, parameter(place, edge));
  }

  EdgeLine edge(const MeasuredPlace& place) const override {
    const PatchEdge edge = edgeOf(place);
    EdgeLine line;
    const auto [length, error] = edges_.lengthOf(edge);
    line.length = length;
    line.accuracy = error;
    line.chainLength = edges_.chainLength(solid_.edgeOf(edge.patch, edge.side));
    line.points = edges_.line(edge, kLinePieces);
    return line;
  }

  /// Principal curvatures are the eigenvalues of I⁻¹ II with the first and second fundamental forms
  /// (do Carmo, Differential Geometry of Curves and Surfaces, section 3.3); the sign is turned, so
  /// that convex is positive with the outward normal.
  Curvatures curvatures(const MeasuredPlace& place) const override {
    PatchPoint point = pointOf(place);
    const Vector3d n = normal(point);
    PatchJet s = search_.jet(point.patch, point.uv);
    if (s.u.cross(s.v).norm() <= 1e-2 * s.u.norm() * s.v.norm()) {
      point.uv = inwards(point);
      s = search_.jet(point.patch, point.uv);
    }
    Eigen::Matrix2d first, second;
    first << s.u.dot(s.u), s.u.dot(s.v), s.u.dot(s.v), s.v.dot(s.v);
    second << s.uu.dot(n), s.uv.dot(n), s.uv.dot(n), s.vv.dot(n);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> eigen(second, first,
                                                                          Eigen::EigenvaluesOnly);
    double a = -eigen.eigenvalues()[0], b = -eigen.eigenvalues()[1];
    if (std::abs(a) < std::abs(b)) std::swap(a, b);
    const double flat = edges_.curvatureError();
    if (std::abs(a) < flat) a = 0;
    if (std::abs(b) < flat) b = 0;
    return {a, b, a == 0 ? 0 : flat / (a * a)};
  }

  Vector3d nearestOn(const MeasuredPlace& place, const Vector3d& x) const override {
    switch (place.what) {
      case What::kFace:
        return search_.nearest(patchOf(place), x).position;
      case What::kEdge:
        return edges_.nearest(edgeOf(place), x).position;
      case What::kPoint:
        break;
    }
    return at(place).position;
  }

  std::vector<Vector3d> samples(const MeasuredPlace& place) const override {
    if (place.what == What::kPoint) return {at(place).position};
    if (place.what == What::kEdge) return edge(place).points;
    std::vector<Vector3d> points = search_.samples(patchOf(place));
    for (const Side side : kSides) {
      const std::vector<Vector3d> border =
          edge({What::kEdge, place.patch, Vector2d(0, 0), side}).points;
      for (std::size_t i = 0; i < border.size(); i += kLinePieces / 4) points.push_back(border[i]);
    }
    return points;
  }

  Vector3d nearest(const Vector3d& x) const override { return search_.nearest(x).position; }

  std::optional<double> firstHit(const Vector3d& origin, const Vector3d& direction,
                                 double least) const override {
    return search_.firstHit(origin, direction, least);
  }

  double facetHeight(const MeasuredPlace&) const override { return 0; }

  MeasuredPlace placeNear(int patch, const Vector3d& x) const override {
    const PatchPoint found = search_.nearest(patch, x);
    return {What::kPoint, solid_.patches()[patch].name, fractions(found)};
  }

  std::optional<MeasuredPlace> edgeNear(int patch, const Vector3d& x) const override {
    MeasuredPlace best;
    double least = std::numeric_limits<double>::infinity();
    for (const Side side : kSides) {
      const PatchPoint found = edges_.nearest({patch, side}, x);
      const double distance = (found.position - x).norm();
      if (distance >= least) continue;
      least = distance;
      best = {What::kEdge, solid_.patches()[patch].name, fractions(found), side};
    }
    return best;
  }

 private:
  int patchOf(const MeasuredPlace& place) const {
    if (const auto patch = solid_.findPatch(place.patch);
        patch && std::holds_alternative<Vector2d>(place.at))
      return *patch;
    throw ModelingError("patch \"" + place.patch +
                        "\": the body has no such patch any more; measure again");
  }

  PatchEdge edgeOf(const MeasuredPlace& place) const {
    return {patchOf(place), place.side.value()};
  }

  double parameter(const MeasuredPlace& place, const PatchEdge& edge) const {
    const auto [low, high] = search_.range(edge.patch, directionOf(edge.side));
    const double t = std::get<Vector2d>(place.at)[directionOf(edge.side)];
    return t >= 1 ? high : low + t * (high - low);
  }

  PatchPoint pointOf(const MeasuredPlace& place) const {
    PatchPoint point{patchOf(place)};
    if (place.what == What::kEdge) {
      const PatchEdge edge = edgeOf(place);
      point.uv = edges_.uvOf(edge, parameter(place, edge));
    } else {
      for (int k = 0; k < 2; ++k) {
        const auto [low, high] = search_.range(point.patch, k);
        const double t = std::get<Vector2d>(place.at)[k];
        point.uv[k] = t >= 1 ? high : low + t * (high - low);
      }
    }
    point.position = search_.position(point.patch, point.uv);
    return point;
  }

  Vector2d fractions(const PatchPoint& point) const {
    Vector2d result;
    for (int k = 0; k < 2; ++k) {
      const auto [low, high] = search_.range(point.patch, k);
      result[k] = std::clamp((point.uv[k] - low) / (high - low), 0.0, 1.0);
    }
    return result;
  }

  /// A little towards the middle of the patch: for corners where the derivatives are parallel.
  Vector2d inwards(const PatchPoint& point) const {
    Vector2d result;
    for (int k = 0; k < 2; ++k) {
      const auto [low, high] = search_.range(point.patch, k);
      result[k] = point.uv[k] + 0.02 * (0.5 * (low + high) - point.uv[k]);
    }
    return result;
  }

  Vector3d normal(const PatchPoint& point) const {
    Vector3d best = Vector3d::Zero();
    for (const Vector2d& uv : {point.uv, inwards(point)}) {
      const PatchJet s = search_.jet(point.patch, uv);
      const Vector3d cross = s.u.cross(s.v);
      if (cross.norm() > 0) best = cross.normalized();
      if (cross.norm() > 1e-2 * s.u.norm() * s.v.norm()) break;
    }
    return best;
  }

  Solid solid_;
  PatchSearch search_;
  PatchEdges edges_;  // of solid_ and search_
};

}  // namespace

std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const Solid& solid) {
  return std::make_shared<MeasuredSolid>(solid);
}

}  // namespace palpa::modeling
