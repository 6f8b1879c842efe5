#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds Edit > Delete: removes the selected support, load or touch, or states why it cannot.
void addDeleteAction(const Workspace& workspace);

}  // namespace palpa::gui
