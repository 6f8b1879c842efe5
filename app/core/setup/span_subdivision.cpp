#include "app/core/setup/span_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpa::app {
namespace {

/// Growth from one element to the next, away from an edge where a support ends.
constexpr double kMaxGrowth = 2.5;
/// Growth of sizes per mm of distance from a mark, mm.
constexpr double kGrowthPerLength = 0.8;
constexpr int kMaxHalvings = 6;
/// Excess width of a function that is accepted, so that a body a little longer than a whole number
/// of elements does not get one more element in each span.
constexpr double kSlack = 0.1;
/// Length of the longest element tried, over the largest even element allowed, and the step by
/// which shorter ones are tried.
constexpr double kMaxLengthRatio = 1.45, kStep = 0.03;

/// Standard deviation of the cubic B-spline over four elements, over the deviation for size 1.
/// The B-spline is the density of Σ w_i t_i with w uniform on the simplex (H. B. Curry and I. J.
/// Schoenberg, 1966), so its variance is Σ (t_i - mean)^2 / 30.
double width(const std::array<double, 4>& sizes) {
  double at = 0, sum = 0, squares = 0;
  for (const double size : sizes) {
    at += size;
    sum += at;
    squares += at * at;
  }
  return std::sqrt((squares - sum * sum / 5) / 10);
}

/// Largest width of a function on evenly divided spans. The elements are mirrored at both ends.
double widest(const std::vector<double>& need, const std::vector<int>& counts) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < need.size(); ++k)
    sizes.insert(sizes.end(), static_cast<std::size_t>(counts[k]), need[k] / counts[k]);
  const auto count = static_cast<int>(sizes.size());
  const auto sizeAt = [&](int e) {
    if (e < 0) e = -1 - e;
    if (e >= count) e = 2 * count - 1 - e;
    return sizes[std::clamp(e, 0, count - 1)];
  };
  double most = 0;
  for (int e = -2; e + 2 <= count; ++e)
    most = std::max(most, width({sizeAt(e), sizeAt(e + 1), sizeAt(e + 2), sizeAt(e + 3)}));
  return most;
}

}  // namespace

std::vector<int> elementCounts(const std::vector<double>& need) {
  // Equal spans get equal numbers.
  for (double longest = kMaxLengthRatio;; longest -= kStep) {
    std::vector<int> counts;
    for (const double each : need)
      counts.push_back(std::max(1, static_cast<int>(std::ceil(each / longest))));
    if (longest <= 1 || widest(need, counts) <= 1 + kSlack) return counts;
  }
}

std::vector<double> rimSizes(double rim) {
  for (int count = 1;; ++count) {
    const auto sum = [&](double growth) {
      double total = 0, size = rim;
      for (int k = 0; k < count; ++k, size *= growth) total += size;
      return total;
    };
    if (sum(kMaxGrowth) < 1) continue;
    double low = 1, high = kMaxGrowth;
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (sum(middle) < 1 ? low : high) = middle;
    }
    std::vector<double> sizes;
    double total = 0, size = rim;
    for (int k = 0; k < count; ++k, size *= high) {
      sizes.push_back(size);
      total += size;
    }
    for (double& each : sizes) each /= total;
    return sizes;
  }
}

namespace {

void halve(double low, double high, const std::vector<SizeMark>& marks, int depth,
           std::vector<double>& ends) {
  const bool isTooLarge =
      depth < kMaxHalvings && std::any_of(marks.begin(), marks.end(), [&](const SizeMark& mark) {
        const double distance = std::max({0.0, low - mark.at, mark.at - high}) * mark.millimetres;
        return (high - low) * mark.millimetres > mark.size + kGrowthPerLength * distance;
      });
  if (isTooLarge) {
    halve(low, (low + high) / 2, marks, depth + 1, ends);
    halve((low + high) / 2, high, marks, depth + 1, ends);
  } else {
    ends.push_back(high);
  }
}

}  // namespace

void halveAtMarks(double low, double high, const std::vector<SizeMark>& marks,
                  std::vector<double>& ends) {
  halve(low, high, marks, 0, ends);
}

}  // namespace palpa::app
