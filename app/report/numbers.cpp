#include "app/report/numbers.h"

#include <cmath>

#include "app/report/text.h"
#include "base/number_with_error.h"

namespace palpa::report {

std::string rounded(double value, double error) {
  if (!(error > 0)) return format("%.4g", value);
  return withDecimals(value, decimalsFor(value, error * std::abs(value)));
}

std::string rounded(const Eigen::Vector3d& vector, double error) {
  if (!(error > 0)) return toText(vector, 4);
  const double length = vector.norm();
  return toText(vector, digitsFor(length, error * length));
}

std::string inDecimalsOf(double value, double whole, double error) {
  if (!(error > 0)) return format("%.4g", value);
  return withDecimals(value, decimalsFor(whole, error * whole));
}

std::string withError(double value, double error) {
  const std::string text = rounded(value, error);
  if (!(error > 0) || value == 0) return text;
  // Above that an estimate says only that the number is of no use.
  if (error > 1) return text + " ± " + percentText(error);
  const double absolute = error * std::abs(value);
  return text + " ± " + errorText(absolute, decimalsFor(value, absolute));
}

std::string percentText(double error) {
  return error > 1 ? "more than 100 %" : format("about %.2g %%", 100 * error);
}

}  // namespace palpa::report
