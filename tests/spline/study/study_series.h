#pragma once

#include <limits>
#include <string>
#include <vector>

namespace palpa::bem::test {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// One solution: a point of the plots.
struct StudyStep {
  int coefficients = 0;  ///< n: places that carry a displacement
  int elements = 0;
  double size = 0;   ///< h, mm: root of the mean area of an element
  double error = 0;  ///< of u, relative
  /// The least error that any function of the same space has, relative.
  double best = kNotMeasured;
  double atLoad = kNotMeasured;        ///< error of u in the middle of the load, relative
  double reaction = kNotMeasured;      ///< error of the force on the support, relative
  double assemble = 0, factorise = 0;  ///< s
};

/// One body solved by one engine with ever finer elements.
struct StudySeries {
  std::string body, engine;
  std::vector<StudyStep> steps;

  const StudyStep& last() const { return steps.back(); }
  /// The exponent k of error ~ h^k between step `i` and the one before; NaN for the first.
  double order(std::size_t i) const;
  double lastOrder() const { return order(steps.size() - 1); }
  /// The same for all steps up to `i`: slope of the straight line that fits the logarithms best.
  double fittedOrder(std::size_t i) const;
};

/// Prints a series as a table. When the environment variable PALPA_STUDY_CSV names a file, appends
/// it there, separated by semicolons, the columns named in the first line.
void report(const StudySeries& series);

}  // namespace palpa::bem::test
