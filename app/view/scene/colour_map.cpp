#include "app/view/scene/colour_map.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace palpa::view {
namespace {

/// Equidistant colours of viridis (S. van der Walt, N. Smith, 2015, CC0); between them the transfer
/// function interpolates in CIELAB, which keeps the lightness linear. The darkest tenth is left
/// out: on the shaded side of a body it would be black.
constexpr std::array<unsigned, 9> kViridis{0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89,
                                           0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};

Colour fromHex(unsigned rgb) {
  return {((rgb >> 16) & 0xff) / 255.0, ((rgb >> 8) & 0xff) / 255.0, (rgb & 0xff) / 255.0};
}

}  // namespace

std::array<double, 2> colourRange(const ScalarField& field) {
  std::array<double, 2> range{0, 1};
  if (field.range) {
    range = *field.range;
  } else if (!field.values.empty()) {
    const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
    range = {*low, *high};
    if (field.colours == ScalarField::Colours::kDiverging) {
      const double largest = std::max(std::abs(*low), std::abs(*high));
      range = {-largest, largest};
    }
  }
  if (range[1] - range[0] <= 1e-12 * std::max(std::abs(range[0]), std::abs(range[1]))) {
    const double half = range[0] == 0 ? 1 : 0.5 * std::abs(range[0]);
    range = {range[0] - half, range[1] + half};
  }
  return range;
}

double colourNumber(const ScalarField& field, double value) {
  return field.isLogarithmic ? std::log10(value) : value;
}

std::array<double, 2> colourNumberRange(const ScalarField& field) {
  const auto [low, high] = colourRange(field);
  return {colourNumber(field, low), colourNumber(field, high)};
}

Ticks fieldTicks(const ScalarField& field, int wanted) {
  const auto [low, high] = colourRange(field);
  Ticks ticks =
      field.isLogarithmic ? logarithmicTicks(low, high, wanted) : niceTicks(low, high, wanted);
  if (!field.isCapped) return ticks;
  // Others near the end would be covered by its label.
  const auto share = [&](double value) {
    const auto [first, last] = colourNumberRange(field);
    return (colourNumber(field, value) - first) / (last - first);
  };
  while (!ticks.values.empty() && share(ticks.values.back()) > 1 - 0.6 / wanted) {
    ticks.values.pop_back();
    ticks.labels.pop_back();
  }
  ticks.values.push_back(high);
  ticks.labels.push_back("≥ " + shortNumber(high / std::pow(10.0, ticks.exponent)));
  if (field.colours != ScalarField::Colours::kDiverging) return ticks;
  while (!ticks.values.empty() && share(ticks.values.front()) < 0.6 / wanted) {
    ticks.values.erase(ticks.values.begin());
    ticks.labels.erase(ticks.labels.begin());
  }
  ticks.values.insert(ticks.values.begin(), low);
  ticks.labels.insert(ticks.labels.begin(),
                      "≤ " + shortNumber(low / std::pow(10.0, ticks.exponent)));
  return ticks;
}

std::vector<Colour> colourSteps(ScalarField::Colours colours, int count) {
  vtkNew<vtkColorTransferFunction> map;
  if (colours == ScalarField::Colours::kDiverging) {
    // K. Moreland, Diverging color maps for scientific visualization (2009).
    map->SetColorSpaceToDiverging();
    map->AddRGBPoint(0, 0.230, 0.299, 0.754);
    map->AddRGBPoint(1, 0.706, 0.016, 0.150);
  } else {
    map->SetColorSpaceToLab();
    for (std::size_t i = 0; i < kViridis.size(); ++i) {
      const Colour colour = fromHex(kViridis[i]);
      const double t = static_cast<double>(i) / (kViridis.size() - 1);
      map->AddRGBPoint(t, colour[0], colour[1], colour[2]);
    }
  }
  map->Build();
  std::vector<Colour> steps(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    map->GetColor(i / (count - 1.0), steps[static_cast<std::size_t>(i)].data());
  }
  return steps;
}

Colour ColourFit::at(double share) const {
  const double place = 2 * std::clamp(share, 0.0, 1.0);
  const Half& half = place > 1 ? upper : lower;
  const double s = place > 1 ? place - 1 : place;
  Colour colour{};
  for (std::size_t i = half.size(); i-- > 0;) {
    for (std::size_t k = 0; k < 3; ++k) colour[k] = colour[k] * s + half[i][k];
  }
  return colour;
}

ColourFit fitColours(ScalarField::Colours colours) {
  constexpr int kSamples = 65;  // of each half
  const std::vector<Colour> steps = colourSteps(colours, 2 * kSamples - 1);
  Eigen::MatrixXd powers(kSamples, ColourFit::kCoefficients);
  for (int i = 0; i < kSamples; ++i) {
    for (int k = 0; k < ColourFit::kCoefficients; ++k) {
      powers(i, k) = std::pow(i / (kSamples - 1.0), k);
    }
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(powers);
  const auto fitHalf = [&](std::size_t first) {
    Eigen::MatrixXd wanted(kSamples, 3);
    for (int i = 0; i < kSamples; ++i) {
      for (int k = 0; k < 3; ++k) {
        wanted(i, k) = steps[first + static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      }
    }
    const Eigen::MatrixXd solution = solver.solve(wanted);
    ColourFit::Half half{};
    for (std::size_t i = 0; i < half.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        half[i][k] = solution(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      }
    }
    return half;
  };
  return {fitHalf(0), fitHalf(kSamples - 1)};
}

}  // namespace palpa::view
