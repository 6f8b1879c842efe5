#pragma once

#include <QSize>
#include <QString>
#include <filesystem>
#include <functional>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

constexpr int kAnimationRate = 30;  // pictures per second

/// Program that makes a video of pictures; empty if none is installed.
QString videoProgram();

/// Draws snapshots (kAnimationRate per second) as numbered PNG files in `folder`, `size` in pixels.
/// Before each picture it processes events and calls `isStopped`; returns false if that was true.
/// Throws ViewError.
bool writeAnimation(Simulation& simulation, ViewportWidget& widget,
                    const std::vector<app::TouchSnapshot>& snapshots,
                    const std::filesystem::path& folder, const QSize& size,
                    const std::function<bool(double fraction)>& isStopped);

/// Makes a video of these pictures. Throws std::runtime_error with the program's output.
void makeVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
               const std::function<bool()>& isStopped);

}  // namespace palpa::gui
