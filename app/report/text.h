#pragma once

#include <Eigen/Core>
#include <clocale>
#include <string>

// Text for users of palpa-cli, and for reports.
namespace palpa::report {

/// While it lives, numbers that this thread prints have the decimal point '.': Qt sets the locale
/// of the process to the user's, and printf() follows it.
class PlainNumbers {
 public:
  PlainNumbers();
  ~PlainNumbers();
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  locale_t plain_, former_;
};

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// "(1.5, 0, -20)": up to `digits` significant digits per number.
std::string toText(const Eigen::Vector3d& vector, int digits = 5);

}  // namespace palpa::report
