#include "app/cli/text.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace palpa::cli {

std::string format(const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, pattern, arguments);
  va_end(arguments);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

std::string toText(const Eigen::Vector3d& vector, int digits) {
  // What is rounding error beside the largest component is zero to a reader; so is -0.
  const double negligible = 1e-8 * vector.cwiseAbs().maxCoeff();
  const Eigen::Vector3d v =
      vector.unaryExpr([&](double x) { return std::abs(x) <= negligible ? 0.0 : x; });
  return format("(%.*g, %.*g, %.*g)", digits, v.x(), digits, v.y(), digits, v.z());
}

Json toJson(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

}  // namespace palpa::cli
