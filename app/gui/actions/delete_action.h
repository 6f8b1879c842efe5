#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Edit > Delete: removes the selected support, load or touch, and says why other things stay.
void addDeleteAction(const Workspace& workspace);

}  // namespace palpa::gui
