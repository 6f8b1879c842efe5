#pragma once

#include "modeling/exchange/drawing.h"
#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Spline through a drawn path.
struct FittedProfile {
  ProfileCurve curve;
  double deviation = 0.0;  ///< mm: largest distance between curve and path, from dense samples
};

/// Limits of fitProfile().
struct FitOptions {
  double tolerance = 0.01;  ///< mm, > 0: largest distance between curve and path
  /// rad: straight lines that turn by less than this angle are taken for a drawn curve and replaced
  /// by one with a continuous tangent, which may leave the lines by more than the tolerance.
  double smoothBelow = 0.0;
};

/// Polyline of degree 1 for a path of straight lines, exactly; otherwise a cubic spline with a
/// corner wherever the path has one (tangents that differ by more than kSmoothAngle), straight
/// where the path is straight, and otherwise with as few knots as the tolerance allows. Throws
/// ModelingError (without a place) if more than Profile::kMaxPoints control points are needed;
/// Cancelled.
FittedProfile fitProfile(const DrawnPath& path, const FitOptions& options, const Job& job = {});

/// Joins open paths where exactly two ends lie within `tolerance` (mm) of one another. Closed paths
/// come first, the larger ones before the smaller ones.
std::vector<DrawnPath> joinedPaths(std::vector<DrawnPath> paths, double tolerance,
                                   const Job& job = {});

/// Corners of the box around the control points of a path; a little larger than the path.
std::array<Eigen::Vector2d, 2> boxOf(const DrawnPath& path);

}  // namespace palpa::modeling
