#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace palpa::verification {

/// Largest relative errors allowed, as in TriangleErrors.
struct TriangleTolerances {
  double displacement, points, traction;
  double resultant = 0;  ///< 0: the cases state none
};

/// Cases of analytic.json with the same field and body, named `name` + "_nu0.30" and so on, and the
/// errors allowed. The tests and the program share one list.
struct AnalyticFamily {
  std::string_view name;
  TriangleTolerances triangles;
  /// Of SplineErrors::points; none for bodies without a solid.
  std::optional<double> splines;
  bool isQuick = false;  ///< part of the short run
};
std::span<const AnalyticFamily> analyticFamilies();

/// Cases that are not run: their names begin with `prefix`.
struct OmittedCases {
  std::string_view prefix, reason;
};
std::span<const OmittedCases> omittedCases();

/// Allowed for AnalyticCase::inconsistency(): differences of order 4 with a step of 0.05 mm; near
/// nu = 0.5 Hooke's law magnifies their rounding.
inline constexpr double kMaxInconsistency = 1e-6;

}  // namespace palpa::verification
