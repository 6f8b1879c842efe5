#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds the tools that place supports, loads, touches and knots.
void addSurfaceTools(const Workspace& workspace);

}  // namespace palpa::gui
