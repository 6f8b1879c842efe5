#pragma once

#include <QString>

#include "app/gui/base/units.h"

namespace palpa::gui {

/// An area (mm²) or a volume (mm³) in the square or cube of the unit chosen for lengths, with five
/// digits, or all before the point up to ten million: "1,000,000 mm³".
QString shownArea(double area, const ShownUnits& units);
QString shownVolume(double volume, const ShownUnits& units);

}  // namespace palpa::gui
