#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modeling/shapes/primitive.h"
#include "modeling/shapes/spline_basis.h"

namespace palpa::modeling {

/// A checked ProfileCurve that can be evaluated, with its parameter scaled to 0 … 1; on a closed
/// curve parameters beyond 1 go on round it. Immutable, copies share their data.
class Profile {
 public:
  /// `path` begins the messages ("extrude: profile"). @throws ModelingError: degree, number and
  /// order of knots; points not finite, too many (kMaxPoints) or beyond the largest length; a
  /// curve that is shorter than the smallest length, stands still, turns back, crosses itself or
  /// has more than kMaxCorners corners.
  Profile(const ProfileCurve& curve, const std::string& path);

  Eigen::Vector2d point(double t) const;
  /// Unit tangent just after (side 1) or just before t (side -1). At the seam of a closed curve the
  /// other end continues it; at an end of an open one both sides are the same.
  Eigen::Vector2d tangent(double t, int side) const;
  /// Angle (rad, 0 … π) by which the tangent jumps at t.
  double turn(double t) const;

  bool isClosed() const;
  int degree() const;
  /// Largest extent of the curve in x or y, mm.
  double size() const;

  /// Parameters in [0, 1) where the tangent turns by more than kSharpAngle, ascending; 0 only for a
  /// closed curve.
  const std::vector<double>& corners() const;

  /// Parameters and points of a polyline along the curve, as fine as the checks need.
  const std::vector<double>& sampleParameters() const;
  const std::vector<Eigen::Vector2d>& samples() const;

  /// Arc length in mm, to about 1e-3: for placing cuts.
  double length() const;
  double lengthUpTo(double t) const;
  /// The parameter where lengthUpTo() has this value.
  double parameterAt(double length) const;

  /// Basis over [0, 1] of splines of this degree that break where the curve does between two
  /// parameters; the curve is one of them when the degree is at least its own.
  SplineBasis basis(double from, double to, int degree) const;

  /// The same curve, run through backwards.
  Profile reversed() const;

  static constexpr int kMaxPoints = 256;
  static constexpr int kMaxCorners = 24;

 private:
  struct Data;

  explicit Profile(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

/// A piece of the profile meets the next one smoothly when the tangent turns by less than this.
inline constexpr double kSmoothAngle = 0.01;  // rad

bool isSmooth(const Profile& profile, double t);

/// Where the polyline first touches or crosses itself; the two places' segment numbers. Segments
/// next to each other are not compared; `closed`: the first and last are next to each other.
std::optional<std::array<int, 2>> selfCrossing(const std::vector<Eigen::Vector2d>& line,
                                               bool closed);

/// "(1.5, 20) mm" for messages.
std::string placeText(const Eigen::Vector2d& point);

}  // namespace palpa::modeling
