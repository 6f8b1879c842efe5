#pragma once

#include <string>
#include <vector>

namespace palpa::verification {

enum class Engine { kTriangles, kSplines };
/// "triangles", "splines".
const char* nameOf(Engine engine);

/// A measured number and what it must be.
struct Check {
  std::string quantity;
  double value = 0;
  double bound = 0;
  bool isLeast = false;  ///< the value must not be smaller than the bound; otherwise not larger

  /// Never, when the value is not a number.
  bool passes() const { return isLeast ? value >= bound : value <= bound; }
  /// How much of the bound is used up: more than 1 fails.
  double used() const;
};

/// One solution of a refinement series.
struct ConvergenceStep {
  int coefficients = 0;  ///< places that carry a displacement
  double size = 0;       ///< h, mm: root of the mean area of an element
  double error = 0;      ///< sqrt(∫ |u_h - u|² / ∫ |u|²) over the surface
  /// The exponent k of error ~ h^k from the step before; 0 for the first.
  double order = 0;
};

/// What came out of one case.
struct Result {
  std::string name;
  std::string engine;    ///< nameOf(), or "-" for what needs none
  std::string data;      ///< of the boundary: "stated" by the case, "mixed", or "-"
  int coefficients = 0;  ///< nodes, or control points; of what needs no engine: cases
  std::vector<Check> checks;
  std::vector<ConvergenceStep> steps;  ///< of a refinement series
  double seconds = 0;

  bool passes() const;
  /// The check that uses up most of its bound.
  const Check& nearest() const;
};

}  // namespace palpa::verification
