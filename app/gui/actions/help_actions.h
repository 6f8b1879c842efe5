#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Fills the Help menu.
void addHelpActions(const Workspace& workspace);

}  // namespace palpa::gui
