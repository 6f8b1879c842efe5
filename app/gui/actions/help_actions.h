#pragma once

#include "app/gui/actions/file_actions.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Fills the Help menu.
void addHelpActions(const Workspace& workspace, FileActions& files);

}  // namespace palpa::gui
