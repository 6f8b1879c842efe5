#pragma once

#include <QString>

#include "app/core/session/rebuild_pipeline.h"

// Requested and reached accuracy in words, for panels and the status bar.
namespace palpa::gui {

/// "0.54 %": two significant digits; "below 0.01 %".
QString percentText(double relative);

/// "Accuracy: about 0.54 % (requested 1 %)"; `requested`: relative, used until it is estimated.
QString accuracyText(const app::RebuildStatus& status, double requested);

/// Why the requested accuracy is not reached, and what memory prevents; empty if it is reached or
/// not known.
QString accuracyReason(const app::RebuildStatus& status);

/// True if a finer mesh is advised for the present project.
bool canRefine(const app::RebuildStatus& status);
/// Effect of refining, or the reason why it is impossible.
QString refineTip(const app::RebuildStatus& status);

}  // namespace palpa::gui
