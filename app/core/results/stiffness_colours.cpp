#include "app/core/results/stiffness_colours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpa::app {
namespace {

constexpr double kCovered = 0.95;  // of the free surface
constexpr std::array kSteps{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
constexpr double kSlack = 1e-9;

/// The nearest steps times a power of ten, not above and not below a value > 0.
std::array<double, 2> around(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double below = kSteps.front(), above = kSteps.back();
  for (const double step : kSteps)
    if (step * power <= value * (1 + kSlack)) below = step;
  for (auto step = kSteps.rbegin(); step != kSteps.rend(); ++step)
    if (*step * power >= value * (1 - kSlack)) above = *step;
  return {below * power, above * power};
}

}  // namespace

StiffnessColours StiffnessColours::of(const bem::BoundaryMesh& mesh,
                                      const bem::TractionSlots& slots,
                                      const std::vector<double>& compliances) {
  std::vector<double> areas(compliances.size(), 0.0);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int slot : slots.ofCorner[t]) areas[slot] += mesh.area(t) / 3;
  std::vector<std::pair<double, double>> places;  // stiffness, area
  double total = 0;
  for (std::size_t slot = 0; slot < compliances.size(); ++slot) {
    if (!(compliances[slot] > 0)) continue;
    places.emplace_back(1 / compliances[slot], areas[slot]);
    total += areas[slot];
  }
  StiffnessColours colours;
  if (places.empty()) return colours;
  std::sort(places.begin(), places.end());
  double covered = 0, stiffest = places.front().first;
  for (const auto& [stiffness, area] : places) {
    stiffest = stiffness;
    if ((covered += area) >= kCovered * total) break;
  }
  colours.range = {around(places.front().first)[0], around(stiffest)[1]};
  if (colours.range[0] == colours.range[1]) colours.range[1] *= 2;
  // Supports have stiffer places, at least at their borders.
  colours.isCapped = places.back().first > colours.range[1] ||
                     std::find(compliances.begin(), compliances.end(), 0.0) != compliances.end();
  return colours;
}

void StiffnessColours::cap(std::vector<double>& stiffnesses) const {
  for (double& value : stiffnesses)
    if (value > range[1]) value = range[1];
}

}  // namespace palpa::app
