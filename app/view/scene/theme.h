#pragma once

#include <array>

namespace palpa::view {

using Colour = std::array<double, 3>;  ///< red, green, blue: 0 … 1

/// The mixture (1 - t) a + t b.
Colour mixed(const Colour& a, const Colour& b, double t);

/// Colours of the light and the dark appearance.
struct ViewportTheme {
  Colour backgroundTop, backgroundBottom;
  Colour body, support, load, hovered, selected, warning;
  Colour line, net, handle, handleHovered, handleSelected, handleFollowing;
  Colour grid, text;
  Colour preview, touch;

  static ViewportTheme light();
  static ViewportTheme dark();
};

// The same in both themes: readable on light and dark grounds.
inline constexpr std::array<Colour, 3> kAxisColours{
    {{0.88, 0.24, 0.24}, {0.30, 0.65, 0.22}, {0.20, 0.46, 0.92}}};  ///< x, y, z
inline constexpr Colour kNormalColour{0.72, 0.34, 0.86};
inline constexpr Colour kHighlightColour{1.00, 0.76, 0.12};
inline constexpr Colour kComparedColour{0.94, 0.43, 0.05};  ///< of the other variant
inline constexpr Colour kAppliedForceColour{0.85, 0.07, 0.22};
inline constexpr Colour kGradientColour{0.00, 0.58, 0.66};  ///< of arrows along a gradient

}  // namespace palpa::view
