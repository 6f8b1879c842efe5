#pragma once

#include <string>
#include <vector>

#include "modeling/shapes/primitive.h"
#include "modeling/shapes/spline_basis.h"

// Checks of the numbers a shape is made from, and the sizes of nets that follow from them.
namespace palpa::modeling {

inline constexpr double kMinLength = 1e-3;    // mm
inline constexpr double kMaxLength = 1e6;     // mm
inline constexpr double kMaxEdgeRatio = 1e4;  // between two lengths of one shape
inline constexpr int kMaxControlPoints = 64;  // per direction and patch

struct NamedLength {
  std::string name;  ///< "the radius"
  double value;      ///< mm
};

/// Every length is within kMinLength … kMaxLength and none is more than
/// kMaxEdgeRatio times another: `cylinder: the height is 0 mm; expected 0.001 … 1000000 mm`.
/// Returns the smallest. @throws ModelingError
double checkLengths(const std::string& shape, const std::vector<NamedLength>& lengths);

/// Degree and number of control points as asked for.
struct NetSize {
  int degree = 3;
  int controlPoints = 0;  ///< per direction and patch; 0: as many as the shape prefers

  int countOr(int preferred) const { return controlPoints > 0 ? controlPoints : preferred; }

  /// For a quarter of a circle: radial error below 1e-4 of the radius for degree 3, and near 1e-3
  /// or below for the others.
  int aroundQuarter() const;
  /// For a straight direction: one control point more than needed, to model with.
  int alongLine() const { return countOr(degree + 2); }
  /// From an apex (0) to a rim. A surface with tangents at its apex cannot be a cone there; spans
  /// that shrink towards it confine the error to a tip of about 1 % of the cone.
  SplineBasis fromApex() const;
  /// A basis whose breaks the shape needs, refined to the number of control points asked for;
  /// without a number to degree + 2, or, where splines of a higher degree must be approximated, to
  /// four times the spans. @throws ModelingError, beginning with `shape`, when it has more already
  SplineBasis fitted(const std::string& shape, const SplineBasis& needed, int degreeOfShape) const;
};

/// The degree is 1 … 5 and the number of control points 0 or degree + 1 … 64. @throws ModelingError
NetSize checkNetSize(const std::string& shape, const Primitive& primitive);

}  // namespace palpa::modeling
