#pragma once

#include "app/gui/tools/point_options.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds the tools that select and change control points.
void addPointTools(const Workspace& workspace, PointOptions& options);

}  // namespace palpa::gui
