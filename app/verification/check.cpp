#include "app/verification/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::verification {

const char* nameOf(Engine engine) {
  switch (engine) {
    case Engine::kTriangles:
      return "triangles";
    case Engine::kSplines:
      return "splines";
    case Engine::kQuadratic:
      return "quadratic";
  }
  return "";
}

double Check::used() const {
  // A bound of 0 is met by 0 alone.
  if (!passes())
    return std::isnan(value) ? std::numeric_limits<double>::infinity()
                             : std::max(isLeast ? bound / value : value / bound, 1.0);
  if (value == bound) return 1;
  return isLeast ? bound / value : value / bound;
}

bool Result::passes() const {
  return std::all_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.passes(); });
}

const Check& Result::nearest() const {
  return *std::max_element(checks.begin(), checks.end(), [](const Check& a, const Check& b) {
    return a.passes() != b.passes() ? a.passes() : a.used() < b.used();
  });
}

}  // namespace palpa::verification
