#pragma once

#include <Eigen/Core>
#include <QString>

#include "app/core/live/touch_loop.h"
#include "app/gui/base/units.h"

// Texts of the Forces panel.
namespace palpa::gui {

/// Significant digits of a force and an energy.
constexpr int kForceDigits = 4;

QString kindText(bem::ContactTool::Kind kind);
/// State of a contact: "sticks", "does not touch".
QString statusText(app::TouchSnapshot::Status status);
/// "0.012, -1.300, 4.682 N": all components with the decimals of the length, so that noise is shown
/// as 0; without the digits that a relative error makes uncertain, if it is known (> 0).
QString vectorText(const Eigen::Vector3d& vector, const Unit& unit, double error = 0);

/// "4.72 ± 0.03 N", rounded to the relative error; without the error if it is 0 (unknown).
QString forceWithError(double force, const Unit& unit, double error);

}  // namespace palpa::gui
