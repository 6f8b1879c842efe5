#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace palpa {

/// Decimals of a number with an absolute error: the place of the error's first digit, such that
/// rounding adds less than the error. Negative for tens, hundreds, …. At most kMaxDigits digits of
/// the number are meant, so an error of 0 is possible; 0 for the number 0.
inline int decimalsFor(double value, double error) {
  constexpr int kMaxDigits = 6;
  if (value == 0) return 0;
  const double magnitude = std::floor(std::log10(std::abs(value)));
  const int most = kMaxDigits - 1 - static_cast<int>(magnitude);
  if (!(error > 0)) return most;
  const int place = -static_cast<int>(std::floor(std::log10(error)));
  // An error above the number itself leaves its first digit.
  return std::clamp(place, -static_cast<int>(magnitude), most);
}

/// Significant digits of a number with an absolute error, see decimalsFor().
inline int digitsFor(double value, double error) {
  if (value == 0) return 1;
  return decimalsFor(value, error) + static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
}

/// The number rounded to so many decimals, without an exponent: 1230 for 1234 and -1 decimals. The
/// decimal sign is a point in every locale.
inline std::string withDecimals(double value, int decimals) {
  if (decimals < 0) {
    const double place = std::pow(10.0, -decimals);
    value = std::round(value / place) * place;
  }
  constexpr int kMaxDecimals = 9;  // smaller numbers have powers of ten
  const bool isTiny = decimals > kMaxDecimals && value != 0;
  const int digits =
      isTiny ? decimals + 1 + static_cast<int>(std::floor(std::log10(std::abs(value)))) : 0;
  std::array<char, 352> text;  // the largest number has 309 digits before the point
  const std::to_chars_result end =
      isTiny ? std::to_chars(text.begin(), text.end(), value, std::chars_format::general,
                             std::max(1, digits))
             : std::to_chars(text.begin(), text.end(), value, std::chars_format::fixed,
                             std::clamp(decimals, 0, kMaxDecimals));
  std::string result(text.begin(), end.ptr);
  // No minus before zeros.
  if (result[0] == '-' && result.find_first_of("123456789") == std::string::npos)
    result.erase(0, 1);
  return result;
}

/// An absolute error in the decimals of its number, rounded up.
inline std::string errorText(double error, int decimals) {
  const double place = std::pow(10.0, -decimals);
  return withDecimals(std::ceil(error / place * (1 - 1e-9)) * place, decimals);
}

}  // namespace palpa
