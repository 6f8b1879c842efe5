#pragma once

#include <QString>

namespace palpa::gui {

/// Makes numbered pictures of touched bodies (sphere, cylinder, gripper finger):
/// FOLDER/sphere/000.png …
void film(const QString& folder);

/// Plots the forces of a table of `palpa-touch-bench --csv` over time; returns an exit code.
int plotSlide(const QString& csv, const QString& png);

}  // namespace palpa::gui
