#pragma once

#include <Eigen/Core>
#include <QString>

#include "app/core/live/touch_loop.h"
#include "app/gui/base/units.h"

// The words of the Forces panel.
namespace palpa::gui {

/// Significant digits of a force and an energy.
constexpr int kForceDigits = 4;

QString kindText(bem::ContactTool::Kind kind);
/// What a contact does: "sticks", "does not touch".
QString statusText(app::TouchSnapshot::Status status);
/// "0.012, -1.300, 4.682 N": all components with as many decimals as the length has, so that what
/// is only noise beside it reads as 0.
QString vectorText(const Eigen::Vector3d& vector, const Unit& unit);

}  // namespace palpa::gui
