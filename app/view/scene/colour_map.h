#pragma once

#include <array>
#include <vector>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"
#include "app/view/scene/ticks.h"

/// Colours of fields. Internal to app/view.
namespace palpa::view {

/// The values at the two ends of the field's colours. Without a range: the extremes of the data,
/// made symmetric about zero for diverging colours; widened if all values are equal.
std::array<double, 2> colourRange(const ScalarField& field);

/// The number that stands for a value between the colours: itself, or its decimal logarithm.
double colourNumber(const ScalarField& field, double value);

/// The numbers of the ends of colourRange().
std::array<double, 2> colourNumberRange(const ScalarField& field);

/// Numbers to write beside the field's colours, about `wanted` (>= 2). Where the field is capped,
/// the last one is its end, "≥ 20".
Ticks fieldTicks(const ScalarField& field, int wanted);

/// `count` >= 2 colours at equal distances, from the lowest value to the highest: viridis
/// (perceptually uniform, readable in grey and for colour-blind people) or Moreland's
/// blue-white-red.
std::vector<Colour> colourSteps(ScalarField::Colours colours, int count);

/// A colour map as polynomials, one for the lower and one for the upper half of the values: within
/// 0.02 of the map in each channel.
struct ColourFit {
  static constexpr int kCoefficients = 6;
  /// Of 1, s, s² …, where s grows from 0 to 1 across the half.
  using Half = std::array<Colour, kCoefficients>;
  Half lower, upper;

  /// At a share in 0 … 1 of the way from the lowest value to the highest.
  Colour at(double share) const;
};

ColourFit fitColours(ScalarField::Colours colours);

}  // namespace palpa::view
