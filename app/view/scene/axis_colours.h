#pragma once

#include <array>

#include "app/view/viewport_scene.h"

namespace palpa::view {

/// Of the x, y and z axes in the interactive view; readable on light and dark grounds.
inline constexpr std::array<Colour, 3> kAxisColours{
    {{0.88, 0.24, 0.24}, {0.30, 0.65, 0.22}, {0.20, 0.46, 0.92}}};

inline constexpr Colour kNormalColour{0.72, 0.34, 0.86};
inline constexpr Colour kHighlightColour{1.00, 0.76, 0.12};

}  // namespace palpa::view
