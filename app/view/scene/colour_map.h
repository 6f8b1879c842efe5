#pragma once

#include <vtkColorTransferFunction.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

#include "app/view/scene.h"
#include "app/view/ticks.h"

/// Colours. Internal to app/view.
namespace palpa::view {

using Colour = std::array<double, 3>;  ///< red, green, blue in 0 … 1

inline constexpr Colour kBodyColour{0.74, 0.80, 0.87};
inline constexpr Colour kSupportColour{0.47, 0.49, 0.53};
inline constexpr Colour kGhostColour{0.45, 0.52, 0.60};
inline constexpr Colour kLineColour{0.13, 0.15, 0.18};
inline constexpr Colour kTextColour{0.10, 0.11, 0.13};
inline constexpr Colour kAppliedForceColour{0.85, 0.07, 0.22};
inline constexpr Colour kReactionColour{0.16, 0.21, 0.30};

/// The values at the two ends of the field's colours. Where the field gives no range: the data's
/// own, made symmetric about zero for diverging colours, and widened when all values are equal.
std::array<double, 2> colourRange(const ScalarField& field);

/// The number that stands for a value in colourMap(): itself, or its decimal logarithm.
double colourNumber(const ScalarField& field, double value);

/// The ends of colourMap(): the numbers of those of colourRange().
std::array<double, 2> colourNumberRange(const ScalarField& field);

/// The field's colours over `colourNumberRange(field)`: viridis (perceptually uniform, readable in
/// grey and for colour-blind people) or Moreland's blue-white-red.
vtkSmartPointer<vtkColorTransferFunction> colourMap(const ScalarField& field);

/// Numbers to write beside the field's colours, about `wanted` (>= 2). Where the field is capped,
/// the last one is its end, "≥ 20".
Ticks fieldTicks(const ScalarField& field, int wanted);

/// `count` >= 2 colours of the map at equal distances, from the lowest value to the highest.
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
