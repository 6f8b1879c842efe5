#pragma once

#include "app/gui/tools/load_tool.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds the menu "New load" with an entry for each kind: loads the selected patches, or continues
/// with the tool. Gravity needs neither.
void addLoadEntries(const Workspace& workspace, LoadTool& tool);

}  // namespace palpa::gui
