#include "app/view/layers/mark_colours.h"

#include <cmath>

#include "app/view/layers/surface_shader.h"

namespace palpa::view {
namespace {

/// Share of the colour of the mark in the colour of a marked triangle.
constexpr double kMarkStrength = 0.82;
constexpr Colour kGrey{0.56, 0.57, 0.58};

std::array<unsigned char, 4> bytes(const Colour& colour, double opacity) {
  const auto byte = [](double value) {
    return static_cast<unsigned char>(std::lround(255 * value));
  };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), byte(opacity)};
}

}  // namespace

Colour markColour(Mark mark, const ViewportTheme& theme) {
  switch (mark) {
    case Mark::kSupport:
      return mixed(theme.body, theme.support, kMarkStrength);
    case Mark::kLoad:
      return mixed(theme.body, theme.load, kMarkStrength);
    case Mark::kHovered:
      return mixed(theme.body, theme.hovered, kMarkStrength);
    case Mark::kSelected:
      return mixed(theme.body, theme.selected, kMarkStrength);
    case Mark::kWarning:
      return mixed(theme.body, theme.warning, kMarkStrength);
    case Mark::kNone:
      break;
  }
  return theme.body;
}

MarkPalette markPalette(const ViewportTheme& theme, bool isWire) {
  MarkPalette palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const auto mark = static_cast<Mark>(i);
    const double tint = mark == Mark::kNone ? 0 : kTintOpacity;
    palette[i] = bytes(markColour(mark, theme), isWire ? tint : 1);
  }
  return palette;
}

SupportColours supportColours(const ViewportTheme& theme, bool hasField) {
  const Colour ground =
      hasField ? mixed(theme.body, kGrey, 0.7) : markColour(Mark::kSupport, theme);
  return {ground, mixed(ground, theme.line, strokeStrength(hasField))};
}

}  // namespace palpa::view
