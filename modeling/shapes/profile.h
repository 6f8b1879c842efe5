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

/// Checked ProfileCurve for evaluation, with its parameter scaled to 0 … 1; on a closed curve
/// parameters above 1 continue into the next round. Immutable; copies share their data.
class Profile {
 public:
  /// `path` is the beginning of messages ("extrude: profile"). Throws ModelingError if the degree,
  /// the number of knots or their order is invalid; if points are not finite, too many (kMaxPoints)
  /// or beyond the largest length; if the curve is shorter than the smallest length, has coincident
  /// points, turns back, crosses itself or has more than kMaxCorners corners.
  Profile(const ProfileCurve& curve, const std::string& path);

  /// Point at t, mm.
  Eigen::Vector2d point(double t) const;
  /// Unit tangent just after (side 1) or just before t (side -1). At the seam of a closed curve it
  /// continues at the other end; at an end of an open curve both sides are equal.
  Eigen::Vector2d tangent(double t, int side) const;
  /// Angle (rad, 0 … π) between the tangents on both sides of t.
  double turn(double t) const;

  bool isClosed() const;
  int degree() const;
  /// Largest extent of the curve in x or y, mm.
  double size() const;

  /// Parameters in [0, 1) where the tangent turns by more than kSharpAngle, ascending; 0 is
  /// possible only for a closed curve.
  const std::vector<double>& corners() const;

  /// Parameters and points (mm) of a polyline along the curve, as fine as the checks need.
  const std::vector<double>& sampleParameters() const;
  const std::vector<Eigen::Vector2d>& samples() const;

  /// Arc length in mm, accurate to about 1e-3: sufficient for choosing cuts.
  double length() const;
  /// Arc length from 0 to t, mm.
  double lengthUpTo(double t) const;
  /// Parameter at which lengthUpTo() has the given value.
  double parameterAt(double length) const;

  /// Basis over [0, 1] of splines of the given degree with the breaks of the curve between two
  /// parameters; it contains the curve if `degree` is at least the curve's degree.
  SplineBasis basis(double from, double to, int degree) const;

  /// Same curve in the opposite direction.
  Profile reversed() const;

  static constexpr int kMaxPoints = 256;
  static constexpr int kMaxCorners = 24;

 private:
  struct Data;

  explicit Profile(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

/// Pieces of the profile join smoothly if the tangent turns by less than this angle.
inline constexpr double kSmoothAngle = 0.01;  // rad

/// True if the profile is smooth at t.
bool isSmooth(const Profile& profile, double t);

/// Numbers of the two segments where a polyline first touches or crosses itself; none if it does
/// not. Adjacent segments are not compared; if `closed`, the first and last are adjacent.
std::optional<std::array<int, 2>> selfCrossing(const std::vector<Eigen::Vector2d>& line,
                                               bool closed);

/// Text "(1.5, 20) mm" for messages.
std::string placeText(const Eigen::Vector2d& point);

}  // namespace palpa::modeling
