#pragma once

#include <QIcon>

namespace palpa::gui {

inline constexpr int kCurveSwatch = 10;  ///< px, side of the square

/// Square in the colour of a curve: ForcePlot::colour().
QIcon curveSwatch(int curve);

}  // namespace palpa::gui
