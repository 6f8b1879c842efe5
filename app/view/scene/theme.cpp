#include "app/view/scene/theme.h"

namespace palpa::view {

Colour mixed(const Colour& a, const Colour& b, double t) {
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) colour[i] = (1 - t) * a[i] + t * b[i];
  return colour;
}

ViewportTheme ViewportTheme::light() {
  ViewportTheme theme;
  theme.backgroundTop = {0.985, 0.988, 0.992};
  theme.backgroundBottom = {0.855, 0.880, 0.910};
  theme.body = {0.76, 0.81, 0.87};
  theme.support = {0.10, 0.60, 0.58};
  theme.load = {1.00, 0.60, 0.14};
  theme.hovered = {0.93, 0.96, 1.00};
  theme.selected = {0.22, 0.52, 0.95};
  theme.warning = {0.88, 0.20, 0.20};
  theme.line = {0.13, 0.16, 0.21};
  theme.net = {0.30, 0.36, 0.45};
  theme.handle = {0.99, 0.99, 1.00};
  theme.handleHovered = {1.00, 0.78, 0.22};
  theme.handleSelected = {0.12, 0.45, 0.95};
  theme.handleFollowing = {0.56, 0.76, 1.00};
  theme.grid = {0.42, 0.47, 0.54};
  theme.text = {0.12, 0.14, 0.18};
  theme.preview = {0.86, 0.18, 0.52};
  theme.touch = {0.58, 0.25, 0.78};
  return theme;
}

ViewportTheme ViewportTheme::dark() {
  ViewportTheme theme;
  theme.backgroundTop = {0.215, 0.230, 0.255};
  theme.backgroundBottom = {0.115, 0.125, 0.140};
  theme.body = {0.47, 0.52, 0.59};
  theme.support = {0.12, 0.66, 0.62};
  theme.load = {1.00, 0.60, 0.16};
  theme.hovered = {0.72, 0.78, 0.87};
  theme.selected = {0.30, 0.60, 1.00};
  theme.warning = {0.95, 0.28, 0.26};
  theme.line = {0.06, 0.07, 0.09};
  theme.net = {0.84, 0.89, 0.96};
  theme.handle = {0.92, 0.94, 0.97};
  theme.handleHovered = {1.00, 0.80, 0.26};
  theme.handleSelected = {0.25, 0.60, 1.00};
  theme.handleFollowing = {0.55, 0.76, 1.00};
  theme.grid = {0.62, 0.66, 0.72};
  theme.text = {0.90, 0.92, 0.95};
  theme.preview = {1.00, 0.42, 0.70};
  theme.touch = {0.78, 0.52, 0.98};
  return theme;
}

}  // namespace palpa::view
