#pragma once

#include <cmath>
#include <initializer_list>

namespace palpa {

/// Smallest 1, 2 or 5 times a power of ten that is not below `least` > 0, up to 1e-9 of it.
inline double roundedUp(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// The number with so many significant digits nearest to `value` != 0.
inline double roundedToDigits(double value, int digits) {
  // Dividing a whole number by a power of ten gives the double nearest to the decimals.
  const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

}  // namespace palpa
