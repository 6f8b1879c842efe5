#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds the tools that select and change control points, with the menu entries that do the same
/// with exact numbers.
void addPointTools(const Workspace& workspace);

}  // namespace palpa::gui
