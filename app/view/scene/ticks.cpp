#include "app/view/scene/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/number_with_error.h"

namespace palpa::view {
namespace {

/// The smallest of 1, 2, 2.5, 5 · 10^k that cuts `span` into at most `wanted` steps.
double roundStep(double span, int wanted) {
  const double raw = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

int decimalsFor(double step) {
  for (int decimals = 0; decimals < 12; ++decimals) {
    const double scaled = step * std::pow(10.0, decimals);
    if (std::abs(scaled - std::round(scaled)) < 1e-6 * scaled) return decimals;
  }
  return 12;
}

}  // namespace

ScaledUnit scaledUnit(const std::string& unit, int exponent) {
  struct Named {
    const char* unit;
    int exponent;
    const char* name;
  };
  static constexpr std::array kNamed{
      Named{"MPa", 3, "GPa"},  Named{"MPa", -3, "kPa"},   Named{"MPa", -6, "Pa"},
      Named{"kPa", 3, "MPa"},  Named{"kPa", 6, "GPa"},    Named{"kPa", -3, "Pa"},
      Named{"Pa", 3, "kPa"},   Named{"Pa", 6, "MPa"},     Named{"Pa", 9, "GPa"},
      Named{"GPa", -3, "MPa"}, Named{"GPa", -6, "kPa"},   Named{"GPa", -9, "Pa"},
      Named{"mm", 3, "m"},     Named{"mm", -3, "µm"},     Named{"mm", -6, "nm"},
      Named{"m", -3, "mm"},    Named{"m", -6, "µm"},      Named{"m", -9, "nm"},
      Named{"N", 3, "kN"},     Named{"N", 6, "MN"},       Named{"N", -3, "mN"},
      Named{"N", -6, "µN"},    Named{"mN", 3, "N"},       Named{"mN", 6, "kN"},
      Named{"mN", -3, "µN"},   Named{"kN", 3, "MN"},      Named{"kN", -3, "N"},
      Named{"kN", -6, "mN"},   Named{"N/mm", 3, "kN/mm"}, Named{"N/mm", -3, "N/m"},
      Named{"N/m", 3, "N/mm"}};
  if (exponent == 0) return {unit, 0};
  for (const Named& each : kNamed)
    if (unit == each.unit && exponent == each.exponent) return {each.name, exponent};
  return {"×10^" + std::to_string(exponent) + (unit.empty() ? "" : " " + unit), 0};
}

Ticks niceTicks(double low, double high, int wanted) {
  Ticks ticks;
  const double largest = std::max(std::abs(low), std::abs(high));
  const bool drawable = std::isfinite(low) && std::isfinite(high) && high - low > 1e-12 * largest &&
                        largest > std::numeric_limits<double>::min();
  if (!drawable) {
    ticks.values = {low};
    ticks.labels = {threeDigits(low)};
    return ticks;
  }
  const int magnitude = static_cast<int>(std::floor(std::log10(largest)));
  if (magnitude < -2 || magnitude > 4) {
    // Engineering notation: exponents in steps of three.
    ticks.exponent = 3 * static_cast<int>(std::floor(magnitude / 3.0));
  }
  const double factor = std::pow(10.0, ticks.exponent);
  const double step = roundStep((high - low) / factor, wanted);
  const int decimals = decimalsFor(step);
  const double slack = 1e-9 * step;
  const auto first = static_cast<long>(std::ceil((low / factor - slack) / step));
  const auto last = static_cast<long>(std::floor((high / factor + slack) / step));
  for (long i = first; i <= last; ++i) {
    ticks.values.push_back(static_cast<double>(i) * step * factor);
    ticks.labels.push_back(withDecimals(static_cast<double>(i) * step, decimals));
  }
  return ticks;
}

Ticks logarithmicTicks(double low, double high, int wanted) {
  if (!(low > 0 && std::isfinite(high) && high > low * (1 + 1e-9)))
    return niceTicks(low, high, wanted);
  // From dense to sparse; the densest that is not too dense.
  static const std::array<std::vector<double>, 4> kSteps{
      {{1, 1.5, 2, 3, 4, 5, 6, 8}, {1, 2, 3, 5}, {1, 2, 5}, {1, 3}}};
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  Ticks ticks;
  const auto fill = [&](const std::vector<double>& steps, int everyPower) {
    ticks = {};
    for (int power = first; power <= last; power += everyPower)
      for (const double step : steps) {
        const double value = step * std::pow(10.0, power);
        if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
        ticks.values.push_back(value);
        ticks.labels.push_back(shortNumber(value));
      }
    return static_cast<int>(ticks.values.size()) <= wanted;
  };
  for (const auto& steps : kSteps)
    if (fill(steps, 1)) {
      // Hardly a factor between the ends: as on a plain scale.
      return ticks.values.size() < 2 ? niceTicks(low, high, wanted) : ticks;
    }
  for (int every = 1; !fill({1}, every); ++every) {
  }
  return ticks;
}

std::string shortNumber(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

std::string threeDigits(double value) {
  if (!std::isfinite(value)) return "not finite";
  if (value == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  if (magnitude < -4 || magnitude > 6) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.2e", value);
    return text.data();
  }
  return withDecimals(value, std::max(0, 2 - magnitude));
}

}  // namespace palpa::view
