#pragma once

#include <string>
#include <vector>

namespace palpa::view {

/// Numbers written beside a colour bar or an axis.
struct Ticks {
  std::vector<double> values;       ///< ascending, multiples of 1, 2, 2.5 or 5 times a power of ten
  std::vector<std::string> labels;  ///< values / 10^exponent, all with the same number of decimals
  int exponent = 0;                 ///< of the common factor; 0 where plain numbers read well
};

/// A unit 10^exponent times as large as another one, by name: "kPa" for "MPa" and -3; "×10^-3 in"
/// where it has no name.
struct ScaledUnit {
  std::string name;
  int exponent = 0;  ///< of ten: numbers in the other unit are divided by it; 0 without a name
};
ScaledUnit scaledUnit(const std::string& unit, int exponent);

/// About `wanted` (>= 2) round numbers within [low, high]. An empty or non-finite range gives the
/// one tick `low`.
Ticks niceTicks(double low, double high, int wanted);

/// About `wanted` (>= 2) numbers with few digits within [low, high], 0 < low, spread evenly in
/// their ratios. Where the ends differ by hardly a factor: as niceTicks().
Ticks logarithmicTicks(double low, double high, int wanted);

/// `value` with as few digits as its first six need: 0.02, 1.5, 300.
std::string shortNumber(double value);

/// `value` with three significant digits, without needless exponent: 0.134, 12.3, 4570.
std::string threeDigits(double value);

}  // namespace palpa::view
