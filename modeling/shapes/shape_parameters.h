#pragma once

#include <string>
#include <vector>

#include "modeling/shapes/primitive.h"
#include "modeling/shapes/spline_basis.h"

// Checks of the parameters of shapes, and the resulting sizes of nets.
namespace palpa::modeling {

inline constexpr double kMinLength = 1e-3;    // mm
inline constexpr double kMaxLength = 1e6;     // mm
inline constexpr double kMaxEdgeRatio = 1e4;  // between two lengths of one shape
inline constexpr int kMaxControlPoints = 64;  // per direction and patch

/// Length with its name for messages.
struct NamedLength {
  std::string name;  ///< "the radius"
  double value;      ///< mm
};

/// Smallest of the given lengths. Throws ModelingError if a length is outside kMinLength …
/// kMaxLength or more than kMaxEdgeRatio times another: `cylinder: the height is 0 mm; expected
/// 0.001 … 1000000 mm`.
double checkLengths(const std::string& shape, const std::vector<NamedLength>& lengths);

/// Requested degree and number of control points.
struct NetSize {
  int degree = 3;
  int controlPoints = 0;  ///< per direction and patch; 0: the shape's default

  int countOr(int preferred) const { return controlPoints > 0 ? controlPoints : preferred; }

  /// Number of control points for a quarter of a circle: radial error below 1e-4 of the radius for
  /// degree 3, and near 1e-3 or below for the others.
  int aroundQuarter() const;
  /// Number for a straight direction: one control point more than needed, for editing.
  int alongLine() const { return countOr(degree + 2); }
  /// Basis from an apex (0) to a rim. A surface with tangents at its apex cannot be a cone there;
  /// spans that shrink towards the apex confine the error to a tip of about 1 % of the cone.
  SplineBasis fromApex() const;
  /// Basis `needed`, whose breaks the shape requires, refined to the requested number of control
  /// points. Without a request it is refined to degree + 2, or to four times the spans if splines
  /// of a higher degree must be approximated. Throws ModelingError (message begins with `shape`) if
  /// `needed` has more control points than requested.
  SplineBasis fitted(const std::string& shape, const SplineBasis& needed, int degreeOfShape) const;
};

/// Net size of a primitive. Throws ModelingError if the degree is not in 1 … 5, or the number of
/// control points is neither 0 nor in degree + 1 … 64.
NetSize checkNetSize(const std::string& shape, const Primitive& primitive);

}  // namespace palpa::modeling
