#pragma once

#include <QString>

#include "app/core/session/rebuild_pipeline.h"

// State of the rebuild in words, for panels, status bar and messages.
namespace palpa::gui {

/// 0 … 100, rounded down.
int percent(double fraction);

/// True if an incremental update of an earlier model makes the present shape touchable.
bool isUpdate(const app::RebuildStatus& status);

/// "Up to date", "Building the model 40 %", …
QString rebuildText(const app::RebuildStatus& status);
/// Reason of a failed build, and its remedy; for a status kFailed.
QString failureText(const app::RebuildStatus& status);
/// Why nothing can be touched yet, for a project without a model, and the next step.
QString waitingText(const app::RebuildStatus& status);
/// The same in a few words, for the status bar.
QString waitingHint(const app::RebuildStatus& status);

}  // namespace palpa::gui
