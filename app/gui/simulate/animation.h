#pragma once

#include <QSize>
#include <QString>
#include <filesystem>
#include <functional>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

constexpr int kAnimationRate = 30;  // pictures per second

/// The program that makes a video of pictures; empty when none is installed.
QString videoProgram();

/// Draws snapshots, kAnimationRate of them per second, as numbered PNG files in `folder`, as the
/// view shows them, `size` in pixels. `isStopped` is asked before each, after a turn of the event
/// loop; false when it said yes. Throws ViewError.
bool writeAnimation(Simulation& simulation, ViewportWidget& widget,
                    const std::vector<app::TouchSnapshot>& snapshots,
                    const std::filesystem::path& folder, const QSize& size,
                    const std::function<bool(double fraction)>& isStopped);

/// Makes a video of such pictures. Throws std::runtime_error with the program's last words.
void makeVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
               const std::function<bool()>& isStopped);

}  // namespace palpa::gui
