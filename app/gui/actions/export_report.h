#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Asks for a file (.html or .pdf) and writes a report of the open project with its touches, with
/// the numbers of `palpa-cli report`. Takes the model that is shown if it belongs to the present
/// project, and builds it otherwise; the user can cancel. Editor::refused states why it is
/// impossible (nothing acts on the body, the project cannot be solved, the file cannot be written).
void exportReport(const Workspace& workspace);

}  // namespace palpa::gui
