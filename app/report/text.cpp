#include "app/report/text.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "base/number_with_error.h"

namespace palpa::report {
namespace {

constexpr int kMaxDecimals = 6;      // smaller numbers have powers of ten
constexpr double kMaxWritten = 1e9;  // larger ones too

}  // namespace

PlainNumbers::PlainNumbers()
    : plain_(newlocale(LC_NUMERIC_MASK, "C", nullptr)), former_(uselocale(plain_)) {}

PlainNumbers::~PlainNumbers() {
  uselocale(former_);
  if (plain_) freelocale(plain_);
}

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
  // Rounding errors, relative to the largest component, and -0 are shown as 0.
  const double negligible = 1e-8 * vector.cwiseAbs().maxCoeff();
  const Eigen::Vector3d v =
      vector.unaryExpr([&](double x) { return std::abs(x) <= negligible ? 0.0 : x; });
  // All components have the decimals of the largest one, so that noise reads as 0.
  const double largest = v.cwiseAbs().maxCoeff();
  const int decimals =
      largest > 0 ? digits - 1 - static_cast<int>(std::floor(std::log10(largest))) : 0;
  const auto number = [&](double x) {
    if (decimals < 0 && largest < kMaxWritten) return withDecimals(x, decimals);
    if (decimals < 0 || decimals > kMaxDecimals) return format("%.*g", digits, x);
    std::string text = format("%.*f", decimals, x);
    if (text.find('.') != std::string::npos) {
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    return text == "-0" ? std::string("0") : text;
  };
  return "(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
}

}  // namespace palpa::report
