#include "modeling/measure/measured_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "modeling/error.h"
#include "modeling/measure/measured_angle.h"
#include "modeling/measure/measured_surface.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using What = MeasuredPlace::What;

/// A ray from the surface has left it after this part of the body's size.
constexpr double kOffSurface = 1e-6;

/// Sine of the angle between a contact of a ball and the tangent plane that is no contact.
constexpr double kKink = 0.02;

/// Nearest points of two places. The pairs of samples with the smallest distances begin alternating
/// projections, which end when both points stop moving.
class ClosestPair {
 public:
  ClosestPair(const MeasuredSurface& surface, const MeasuredPlace& a, const MeasuredPlace& b)
      : surface_(surface), a_(a), b_(b) {
    std::vector<std::pair<double, Vector3d>> starts;
    const std::vector<Vector3d> from = surface.samples(a), to = surface.samples(b);
    for (const Vector3d& p : from) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& q : to) least = std::min(least, (p - q).squaredNorm());
      starts.emplace_back(least, p);
    }
    constexpr std::size_t kStarts = 6;
    const std::size_t count = std::min(kStarts, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(count),
                      starts.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t i = 0; i < count; ++i) improve(starts[i].second);
  }

  MeasuredValue value() const {
    MeasuredValue value;
    value.value = (points_[1] - points_[0]).norm();
    value.accuracy = accuracy_ + kMeasuredRounding * surface_.size();
    value.points = {points_[0], points_[1]};
    return value;
  }

 private:
  void improve(Vector3d p) {
    constexpr int kMaxSteps = 200;
    Vector3d q = surface_.nearestOn(b_, p);
    double moved = std::numeric_limits<double>::infinity(), fell = 0;
    for (int step = 0; step < kMaxSteps && moved > kMeasuredRounding * surface_.size(); ++step) {
      const double before = (q - p).norm();
      const Vector3d next = surface_.nearestOn(a_, q);
      moved = (next - p).norm();
      p = next;
      q = surface_.nearestOn(b_, p);
      fell = before - (q - p).norm();
    }
    const double distance = (q - p).norm();
    if (distance >= least_) return;
    least_ = distance;
    points_ = {p, q};
    // Each step falls by at most the last fall; a slow end falls by as much again over all steps.
    accuracy_ = moved > kMeasuredRounding * surface_.size() ? kMaxSteps * std::max(fell, 0.0) : 0;
  }

  const MeasuredSurface& surface_;
  const MeasuredPlace& a_;
  const MeasuredPlace& b_;
  double least_ = std::numeric_limits<double>::infinity();
  double accuracy_ = 0;
  std::array<Vector3d, 2> points_{Vector3d::Zero(), Vector3d::Zero()};
};

MeasuredValue lengthOf(const MeasuredSurface& surface, const MeasuredPlace& place) {
  EdgeLine line = surface.edge(place);
  MeasuredValue value;
  value.value = line.length;
  if (line.chainLength > line.length * (1 + 1e-9)) value.second = line.chainLength;
  value.accuracy = line.accuracy;
  value.points = std::move(line.points);
  return value;
}

/// Diameter of the largest ball that touches the surface at the place from inside: a ball on the
/// inner normal shrinks until no point of the surface lies inside (Ma, Bae and Choi, The Visual
/// Computer 28 (2012), the shrinking ball).
double inscribedDiameter(const MeasuredSurface& surface, const MeasuredPlace& place,
                         double thickness) {
  const PlacePoint p = surface.at(place);
  const double allowed = std::max(surface.facetHeight(place), 1e-10 * surface.size());
  double radius = 0.5 * thickness;
  // Points next to the place touch by its curvature.
  try {
    if (const double strong = surface.curvatures(place).strong; strong > 0)
      radius = std::min(radius, 1 / strong);
  } catch (const ModelingError&) {
    // Too few triangles for a curvature: the facets alone limit the ball.
  }
  for (int step = 0; step < 100; ++step) {
    const Vector3d centre = p.position - radius * p.normal;
    const Vector3d q = surface.nearest(centre);
    const double inside = radius - (q - centre).norm();
    const Vector3d way = q - p.position;
    const double depth = -way.dot(p.normal);
    // A shallow contact is a kink of a smooth surface, as at an edge between two approximations.
    if (inside <= allowed || depth <= kKink * way.norm()) break;
    const double next = way.squaredNorm() / (2 * depth);
    if (next >= radius) break;
    radius = next;
  }
  return 2 * radius;
}

MeasuredValue thicknessOf(const MeasuredSurface& surface, const MeasuredPlace& place) {
  const PlacePoint p = surface.at(place);
  const auto hit = surface.firstHit(p.position, -p.normal, kOffSurface * surface.size());
  if (!hit)
    throw ModelingError("patch \"" + place.patch +
                        "\": no surface lies opposite to the place; measure beside it");
  MeasuredValue value;
  value.value = *hit;
  value.accuracy = 10 * kMeasuredRounding * surface.size();
  value.second = inscribedDiameter(surface, place, *hit);
  value.points = {p.position, p.position - *hit * p.normal};
  return value;
}

MeasuredValue radiusOf(const MeasuredSurface& surface, const MeasuredPlace& place) {
  const auto radius = [](double curvature) {
    return curvature == 0 ? std::numeric_limits<double>::infinity() : 1 / curvature;
  };
  MeasuredValue value;
  if (place.what == What::kEdge) {
    const EdgePoint point = surface.edgeAt(place);
    value.value = radius(point.curvature.norm());
    value.accuracy = point.accuracy;
    value.fit = point.fit;
    value.points = {point.position};
    if (std::isfinite(value.value))
      value.points.emplace_back(point.position + value.value * value.value * point.curvature);
    return value;
  }
  const PlacePoint point = surface.at(place);
  const Curvatures found = surface.curvatures(place);
  value.value = radius(found.strong);
  value.second = radius(found.weak);
  value.accuracy = found.accuracy;
  value.fit = found.fit;
  value.points = {point.position};
  if (std::isfinite(value.value))
    value.points.emplace_back(point.position - value.value * point.normal);
  return value;
}

}  // namespace

MeasuredBody::MeasuredBody(const Body& body)
    : surface_(std::visit([](const auto& one) { return makeMeasuredSurface(one); }, body)) {}

MeasuredValue MeasuredBody::measure(const Measurement& measurement) const {
  checkMeasurement(measurement, "measurement");
  const auto& places = measurement.places;
  switch (measurement.kind) {
    case MeasurementKind::kDistance:
      return ClosestPair(*surface_, places[0], places[1]).value();
    case MeasurementKind::kLength:
      return lengthOf(*surface_, places[0]);
    case MeasurementKind::kAngle:
      return angleOf(*surface_, places);
    case MeasurementKind::kThickness:
      return thicknessOf(*surface_, places[0]);
    case MeasurementKind::kRadius:
      break;
  }
  return radiusOf(*surface_, places[0]);
}

Vector3d MeasuredBody::position(const MeasuredPlace& place) const {
  return surface_->at(place).position;
}

std::vector<Vector3d> MeasuredBody::edgeLine(const MeasuredPlace& place) const {
  return surface_->edge(place).points;
}

std::optional<MeasuredPlace> MeasuredBody::edgeNear(int patch, const Vector3d& point) const {
  return surface_->edgeNear(patch, point);
}

MeasuredPlace MeasuredBody::placeNear(int patch, const Vector3d& point) const {
  return surface_->placeNear(patch, point);
}

}  // namespace palpa::modeling
