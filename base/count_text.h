#pragma once

#include <cmath>
#include <cstddef>
#include <string>

namespace palpa {

/// A number of things for users, rounded to a whole number: "24,512". The separator is ',' whatever
/// the locale, as in all messages of the libraries.
inline std::string countText(double count) {
  if (!(std::abs(count) < 1e15)) return "more than a million billion";
  const long long whole = std::llround(count);
  std::string digits = std::to_string(whole);
  const std::size_t first = whole < 0 ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) digits.insert(at -= 3, ",");
  return digits;
}

/// An estimated number of things, with three significant digits: "24,500".
inline std::string estimateText(double count) {
  if (!(std::abs(count) >= 1000) || !(std::abs(count) < 1e15)) return countText(count);
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(count))) - 2);
  return countText(unit * std::round(count / unit));
}

}  // namespace palpa
