#pragma once

#include <array>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Colours of marked parts of the body. Internal to app/view.
namespace palpa::view {

/// Colour of marked triangles; of the body itself without a mark.
Colour markColour(Mark mark, const ViewportTheme& theme);

/// In the wire picture only marked triangles are drawn, as a tint of this opacity.
inline constexpr double kTintOpacity = 0.35;

/// Red, green, blue and opacity, 0 to 255, by mark.
using MarkPalette = std::array<std::array<unsigned char, 4>, 6>;
/// `isWire`: of the wire picture.
MarkPalette markPalette(const ViewportTheme& theme, bool isWire);

/// Colours of supports and of the strokes of their hatching.
struct SupportColours {
  Colour ground, stroke;
};
/// `hasField`: beside the colours of a field supports are grey.
SupportColours supportColours(const ViewportTheme& theme, bool hasField);

}  // namespace palpa::view
