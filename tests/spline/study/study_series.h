#pragma once

#include <limits>
#include <string>
#include <vector>

namespace palpa::bem::test {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// One solution: one point of the plots.
struct StudyStep {
  int coefficients = 0;  ///< n: number of displacement coefficients
  int elements = 0;
  double size = 0;   ///< h, mm: root of the mean area of an element
  double error = 0;  ///< of u, relative
  /// Smallest possible error of a function of the same space, relative.
  double best = kNotMeasured;
  double atLoad = kNotMeasured;        ///< error of u in the middle of the load, relative
  double reaction = kNotMeasured;      ///< error of the force on the support, relative
  double assemble = 0, factorise = 0;  ///< s
};

/// Solutions of one body by one engine with increasingly fine elements.
struct StudySeries {
  std::string body, engine;
  std::vector<StudyStep> steps;

  const StudyStep& last() const { return steps.back(); }
  /// Exponent k of error ~ h^k between step `i` and the previous step; NaN for the first.
  double order(std::size_t i) const;
  double lastOrder() const { return order(steps.size() - 1); }
  /// Exponent k for all steps up to `i`: slope of the least-squares line through the logarithms.
  double fittedOrder(std::size_t i) const;
};

/// Prints a series as a table. If the environment variable PALPA_STUDY_CSV names a file, also
/// appends the series to it, separated by semicolons, with column names in the first line.
void report(const StudySeries& series);

}  // namespace palpa::bem::test
