#include "modeling/shapes/profile.h"

#include <BSplCLib.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/shapes/profile_check.h"
#include "modeling/shapes/profile_error.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {

using Eigen::Vector2d;

struct Profile::Data {
  explicit Data(const ProfileCurve& curve);

  SplineBasis basis;
  TColgp_Array1OfPnt2d points;
  TColStd_Array1OfReal flatKnots;
  bool closed = false;
  double size = 0.0;
  std::vector<double> corners;
  std::vector<double> parameters;
  std::vector<Vector2d> samples;
  std::vector<double> lengths;  // of the polyline up to each sample
};

namespace {

/// Parameters dense enough that the chords between them represent the curve.
std::vector<double> sampleParametersOf(const SplineBasis& basis) {
  std::vector<double> parameters;
  const int perSpan = basis.degree == 1 ? 1 : std::max(16, 128 / basis.spanCount());
  for (std::size_t i = 1; i < basis.knots.size(); ++i) {
    const double low = basis.knots[i - 1], high = basis.knots[i];
    for (int k = 0; high > low && k < perSpan; ++k)
      parameters.push_back(low + (high - low) * k / perSpan);
  }
  parameters.push_back(1.0);
  return parameters;
}

/// Where two segments of a polyline meet; the first point of the first one if they are parallel.
Vector2d meetingPoint(const std::vector<Vector2d>& line, const std::array<int, 2>& segments) {
  const auto [i, j] = segments;
  const Vector2d a = line[i + 1] - line[i], b = line[j + 1] - line[j], between = line[j] - line[i];
  const double turn = a.x() * b.y() - a.y() * b.x();
  if (std::abs(turn) <= 1e-9 * a.norm() * b.norm()) return line[i];
  const double share = (between.x() * b.y() - between.y() * b.x()) / turn;
  return line[i] + std::clamp(share, 0.0, 1.0) * a;
}

}  // namespace

Profile::Data::Data(const ProfileCurve& curve)
    : basis{curve.degree, {}},
      points(1, static_cast<int>(curve.points.size())),
      flatKnots(1, static_cast<int>(curve.knots.size())) {
  const double range = curve.knots.back() - curve.knots.front();
  for (double knot : curve.knots) {
    basis.knots.push_back((knot - curve.knots.front()) / range);
    flatKnots.SetValue(static_cast<int>(basis.knots.size()), basis.knots.back());
  }
  Vector2d low = curve.points.front(), high = low;
  for (const Vector2d& p : curve.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  size = (high - low).maxCoeff();
  closed = (curve.points.back() - curve.points.front()).norm() <= 1e-9 * size;
  for (int i = 1; i <= points.Length(); ++i) {
    const bool isSeam = closed && i == points.Length();
    const Vector2d& p = isSeam ? curve.points.front() : curve.points[i - 1];
    points.SetValue(i, gp_Pnt2d(p.x(), p.y()));
  }
}

Profile::Profile(std::shared_ptr<const Data> data) {
  const auto complete = std::make_shared<Data>(*data);
  data_ = complete;
  complete->parameters = sampleParametersOf(complete->basis);
  for (double t : complete->parameters) {
    auto& samples = complete->samples;
    auto& lengths = complete->lengths;
    const Vector2d p = point(t);
    lengths.push_back(samples.empty() ? 0.0 : lengths.back() + (p - samples.back()).norm());
    samples.push_back(p);
  }
  const auto& knots = complete->basis.knots;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    if (knots[i] == knots[i + 1] || (knots[i] == 0.0 && !isClosed())) continue;
    if (turn(knots[i]) > kSharpAngle) complete->corners.push_back(knots[i]);
  }
}

Profile::Profile(const ProfileCurve& curve, const std::string& path) {
  checkProfileCurve(curve, path);
  *this = Profile(std::make_shared<const Data>(curve));
  const auto& samples = data_->samples;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if ((samples[i] - samples[i - 1]).norm() <= 1e-9 * size())
      throw ProfileError(path + ": points of the curve coincide at " + placeText(samples[i]) +
                             "; remove all but one",
                         samples[i]);
  for (double knot : data_->basis.knots)
    if (turn(knot) > 0.99 * std::numbers::pi)
      throw ProfileError(path + ": the curve turns back on itself at " + placeText(point(knot)),
                         point(knot));
  if (const auto crossing = selfCrossing(samples, isClosed())) {
    const Vector2d at = meetingPoint(samples, *crossing);
    throw ProfileError(path + ": the curve crosses or touches itself near " + placeText(at), at);
  }
  if (corners().size() > kMaxCorners)
    throw ModelingError(path + ": the curve has " + std::to_string(corners().size()) +
                        " corners; at most " + std::to_string(kMaxCorners) + " are possible");
}

bool Profile::isClosed() const {
  return data_->closed;
}

int Profile::degree() const {
  return data_->basis.degree;
}

double Profile::size() const {
  return data_->size;
}

const std::vector<double>& Profile::corners() const {
  return data_->corners;
}

const std::vector<double>& Profile::sampleParameters() const {
  return data_->parameters;
}

const std::vector<Vector2d>& Profile::samples() const {
  return data_->samples;
}

Vector2d Profile::point(double t) const {
  if (t > 1.0 && isClosed()) t -= std::floor(t);
  gp_Pnt2d p;
  BSplCLib::D0(std::clamp(t, 0.0, 1.0), 0, data_->basis.degree, false, data_->points, nullptr,
               data_->flatKnots, nullptr, p);
  return {p.X(), p.Y()};
}

Vector2d Profile::tangent(double t, int side) const {
  // Chords instead of derivatives: where control points coincide the derivative is zero, but the
  // curve has a direction.
  constexpr double kStep = 1e-4;
  constexpr double kAtKnot = 1e-9;
  if (t > 1.0 && isClosed()) t -= std::floor(t);
  double step = kStep;
  for (double knot : data_->basis.knots)
    if (std::abs(knot - t) < kAtKnot) t = knot;
  for (double knot : data_->basis.knots)
    if (knot != t && (knot > t) == (side > 0)) step = std::min(step, 0.5 * std::abs(knot - t));
  if (t <= 0.0 && side < 0) return isClosed() ? tangent(1.0, -1) : tangent(0.0, 1);
  if (t >= 1.0 && side > 0) return isClosed() ? tangent(0.0, 1) : tangent(1.0, -1);
  return (side * (point(t + side * step) - point(t))).normalized();
}

double Profile::turn(double t) const {
  return std::acos(std::clamp(tangent(t, -1).dot(tangent(t, 1)), -1.0, 1.0));
}

double Profile::length() const {
  return data_->lengths.back();
}

double Profile::lengthUpTo(double t) const {
  const auto& parameters = data_->parameters;
  const auto& lengths = data_->lengths;
  const double rounds = t > 1.0 && isClosed() ? std::floor(t) : 0.0;
  const auto above = std::upper_bound(parameters.begin(), parameters.end(), t - rounds);
  if (above == parameters.begin()) return rounds * length();
  if (above == parameters.end()) return (rounds + 1.0) * length();
  const std::size_t i = above - parameters.begin();
  const double part = (t - rounds - parameters[i - 1]) / (parameters[i] - parameters[i - 1]);
  return rounds * length() + lengths[i - 1] + part * (lengths[i] - lengths[i - 1]);
}

double Profile::parameterAt(double length) const {
  const auto& parameters = data_->parameters;
  const auto& lengths = data_->lengths;
  const double rounds =
      length > lengths.back() && isClosed() ? std::floor(length / lengths.back()) : 0.0;
  const double rest = length - rounds * lengths.back();
  const auto above = std::upper_bound(lengths.begin(), lengths.end(), rest);
  if (above == lengths.begin()) return rounds;
  if (above == lengths.end()) return rounds + 1.0;
  const std::size_t i = above - lengths.begin();
  const double part = (rest - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
  return rounds + parameters[i - 1] + part * (parameters[i] - parameters[i - 1]);
}

SplineBasis Profile::basis(double from, double to, int degree) const {
  constexpr double kAtEnd = 1e-6;  // inner knots closer to an end are omitted
  const auto& knots = data_->basis.knots;
  const int curveDegree = data_->basis.degree;
  const double rounds = std::floor(from);
  std::vector<double> inner;
  const auto addKnot = [&](double at, int multiplicity) {
    const double x = (at + rounds - from) / (to - from);
    if (x > kAtEnd && x < 1.0 - kAtEnd) inner.insert(inner.end(), multiplicity, x);
  };
  for (double round : {0.0, 1.0}) {
    for (std::size_t i = curveDegree + 1; i + curveDegree + 1 < knots.size();) {
      const double knot = knots[i];
      int multiplicity = 0;
      for (; knots[i] == knot; ++i) ++multiplicity;
      addKnot(knot + round, std::clamp(degree - curveDegree + multiplicity, 1, degree));
    }
    // At the seam the curve is only known to be continuous.
    addKnot(round + 1.0, degree);
  }
  SplineBasis basis{degree, std::vector<double>(degree + 1, 0.0)};
  basis.knots.insert(basis.knots.end(), inner.begin(), inner.end());
  basis.knots.insert(basis.knots.end(), degree + 1, 1.0);
  return basis;
}

Profile Profile::reversed() const {
  ProfileCurve curve;
  curve.degree = data_->basis.degree;
  curve.knots = modeling::reversed(data_->basis).knots;
  for (int i = data_->points.Upper(); i >= 1; --i)
    curve.points.emplace_back(data_->points(i).X(), data_->points(i).Y());
  return Profile(std::make_shared<const Data>(curve));
}

bool isSmooth(const Profile& profile, double t) {
  return profile.turn(t) < kSmoothAngle;
}

std::string placeText(const Vector2d& point) {
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, "(%.4g, %.4g) mm", point.x() + 0.0, point.y() + 0.0);
  return buffer;
}

}  // namespace palpa::modeling
