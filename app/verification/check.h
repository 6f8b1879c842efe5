#pragma once

#include <string>
#include <vector>

namespace palpa::verification {

enum class Engine { kTriangles, kSplines, kQuadratic };
/// "triangles", "splines", "quadratic".
const char* nameOf(Engine engine);

/// A measured number and its bound.
struct Check {
  std::string quantity;
  double value = 0;
  double bound = 0;
  bool isLeast = false;  ///< true for a lower bound, false for an upper one

  /// False if the value is not a number.
  bool passes() const { return isLeast ? value >= bound : value <= bound; }
  /// Used part of the bound: more than 1 fails.
  double used() const;
};

/// One solution of a refinement series.
struct ConvergenceStep {
  int coefficients = 0;  ///< of the displacement
  double size = 0;       ///< h, mm: root of the mean area of an element
  double error = 0;      ///< sqrt(∫ |u_h - u|² / ∫ |u|²) over the surface
  /// The exponent k of error ~ h^k from the step before; 0 for the first.
  double order = 0;
};

/// The result of one case.
struct Result {
  std::string name;
  std::string engine;    ///< nameOf(), or "-" for cases without an engine
  std::string data;      ///< of the boundary: "stated" by the case, "mixed", or "-"
  int coefficients = 0;  ///< nodes or control points; without an engine, cases
  std::vector<Check> checks;
  std::vector<ConvergenceStep> steps;  ///< of a refinement series
  double seconds = 0;

  bool passes() const;
  /// The check with the largest used().
  const Check& nearest() const;
};

}  // namespace palpa::verification
