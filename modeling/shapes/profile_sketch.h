#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "modeling/shapes/primitive.h"
#include "modeling/shapes/spline_basis.h"

namespace palpa::modeling {

/// Course of a sketched curve at a point.
enum class SketchPointKind {
  kControl,  ///< control point beside the curve, which it attracts
  kCorner,   ///< point on the curve, which may have a corner there
  kSmooth,   ///< point on the curve with one tangent: it and its neighbours stay in line
};

/// Point of a sketch. The ends of an open curve are always on the curve; kControl then states that
/// the point becomes a control point when the curve continues there.
struct SketchPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< mm
  SketchPointKind kind = SketchPointKind::kCorner;

  bool operator==(const SketchPoint&) const = default;
};

/// Point on the curve of a sketch.
struct SketchPlace {
  int run = 0;                                   ///< from 0, see ProfileSketch
  double u = 0.0;                                ///< 0 … 1 along the run
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< mm
};

/// Plane curve while it is drawn and edited. Points on the curve divide it into runs. A run without
/// control points is a straight line and stays straight when its ends move; one with fewer control
/// points than the degree needs is a Bézier curve of lower degree, any other a clamped spline.
///
/// Any edit is allowed: the curve may be incomplete or cross itself; checkRevolvedProfile() and
/// checkClosedProfile() judge curve(). Points are numbered from 0; on a closed curve point 0 is on
/// the curve and is not repeated at the end. Throws std::out_of_range for a number beyond that.
class ProfileSketch {
 public:
  /// Empty open curve, which grows with degree 3.
  ProfileSketch() = default;
  /// Curve with valid degree and knots (throws ModelingError otherwise). Straight pieces lose their
  /// control points, so that curve() can be of degree 1; the shape is the same.
  explicit ProfileSketch(const ProfileCurve& curve);

  const std::vector<SketchPoint>& points() const { return points_; }
  int pointCount() const { return static_cast<int>(points_.size()); }
  bool isClosed() const { return closed_; }
  int degree() const { return degree_; }  ///< of runs with enough control points
  bool isOnCurve(int point) const;

  /// True if there are enough points for curve(): two, or three of a closed curve.
  bool isCurve() const { return pointCount() >= (closed_ ? 3 : 2); }
  /// Degree 1 if all runs are straight. Throws std::logic_error unless isCurve().
  ProfileCurve curve() const;
  /// Points along the curve for drawing and picking, 2 on a straight run. Empty unless isCurve().
  std::vector<SketchPlace> samples() const;
  /// Location on a run at the parameter u (0 … 1), mm.
  Eigen::Vector2d at(int run, double u) const;
  /// Minimum and maximum corner of the box around the curve, or around its points while there is no
  /// curve, mm; both zero without points.
  std::array<Eigen::Vector2d, 2> box() const;

  // Drawing. A closed curve has no ends.

  /// Adds a point after the last one; kControl lets the curve pass beside it once it continues.
  void append(const Eigen::Vector2d& at, SketchPointKind kind);
  /// Joins the last point to the first. Without corners the result is smooth everywhere; its first
  /// point is then a point on the curve. Does nothing with fewer than three points.
  void close();
  /// Opens a closed curve at its first point: removes the straight line that closes it; without one
  /// the first point is then the first and the last.
  void open();

  // Editing

  /// Moves points; a control point beside a smooth point turns the one opposite about it.
  void move(const std::vector<int>& points, const Eigen::Vector2d& by);
  /// Inserts a point on the curve; the shape stays. A straight run gets a corner. Returns the new
  /// point nearest to the place.
  int insert(const SketchPlace& place);
  /// Removes points; their neighbours stay.
  void remove(std::vector<int> points);
  /// Makes a point a corner, so that the curve passes through it.
  void makeCorner(int point);
  /// Lets the curve pass smoothly: a corner becomes a control point, or a point with one tangent if
  /// it is the only point on a closed curve. An end of an open curve stays on the curve until the
  /// curve continues there (see SketchPoint).
  void makeSmooth(int point);
  /// Scales about a location. Factors other than 0; negative ones mirror.
  void scale(const Eigen::Vector2d& factors, const Eigen::Vector2d& about);
  /// Completes a symmetric curve: adds the mirror image about the line x = `at` (axis 0) or y =
  /// `at` (axis 1) to an open curve with one or both ends on the line. An end within `tolerance` of
  /// the line moves onto it. False if no end is there.
  bool addMirrorImage(int axis, double at, double tolerance);

  bool operator==(const ProfileSketch&) const = default;

 private:
  /// Inner knots of a run in (0, 1): inner points + 1 - degree, or none.
  using Knots = std::vector<double>;
  /// Run as a clamped spline or Bézier curve over [0, 1].
  struct Spline {
    SplineBasis basis;
    std::vector<Eigen::Vector2d> points;
  };

  int runCount() const { return static_cast<int>(knots_.size()); }
  /// First points of all runs; for an open curve also its last point.
  std::vector<int> runStarts() const;
  int runOf(int controlPoint) const;
  int next(int point) const;
  int previous(int point) const;
  Spline spline(int run) const;
  /// The same with the degree of the sketch.
  Spline elevated(int run) const;
  /// Makes a control point a corner between two runs.
  void split(int point);
  /// Makes a point between two runs a control point of one run. Returns its new number.
  int join(int point);
  /// Renumbers a closed curve to begin at a point on the curve.
  void rotateSeam(int point);
  /// Puts the neighbours of a smooth point in line with it; one of them, or none (-1), keeps its
  /// direction.
  void align(int point, int fixedNeighbour);
  void removeOne(int point);
  void makeSeamSmooth();
  /// Largest (`sign` 1) or smallest (-1) coordinate near the sample with the most extreme one.
  double extreme(const std::vector<SketchPlace>& places, std::size_t most, int axis,
                 double sign) const;

  int degree_ = 3;
  bool closed_ = false;
  std::vector<SketchPoint> points_;
  std::vector<Knots> knots_;  // per run
};

}  // namespace palpa::modeling
