#include "app/cli/text.h"

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

std::string toText(const Eigen::Vector3d& v, int digits) {
  // Adding zero turns -0 into 0.
  return format("(%.*g, %.*g, %.*g)", digits, v.x() + 0.0, digits, v.y() + 0.0, digits,
                v.z() + 0.0);
}

std::string memoryText(double bytes) {
  constexpr double kMebi = 1024.0 * 1024.0;
  if (bytes >= 1024 * kMebi) return format("%.1f GiB", bytes / (1024 * kMebi));
  return format("%.0f MiB", bytes / kMebi);
}

Json toJson(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

}  // namespace palpa::cli
