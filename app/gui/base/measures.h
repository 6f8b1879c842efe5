#pragma once

#include <QString>

#include "app/gui/base/units.h"

namespace palpa::gui {

/// Area (mm²) or volume (mm³) in the square or cube of the chosen unit of length, with five digits,
/// or all digits before the point up to ten million: "1,000,000 mm³".
QString shownArea(double area, const ShownUnits& units);
QString shownVolume(double volume, const ShownUnits& units);

}  // namespace palpa::gui
