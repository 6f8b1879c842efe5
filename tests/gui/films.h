#pragma once

#include <QString>

namespace palpa::gui {

/// Numbered pictures of the sphere, the cylinder and the gripper finger being touched with the
/// mouse: FOLDER/sphere/000.png …
void film(const QString& folder);

/// Draws the forces of a table that `palpa-touch-bench --csv` wrote over time; returns an exit
/// code.
int plotSlide(const QString& csv, const QString& png);

}  // namespace palpa::gui
