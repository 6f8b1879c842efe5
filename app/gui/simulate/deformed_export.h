#pragma once

#include "app/gui/simulate/simulation.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Asks for a format and a file and writes the solid as it is touched now: patches as a project or
/// CAD file, or its triangles. Says why when the model is one of triangles or nothing is shown yet.
void exportDeformed(const Workspace& workspace, Simulation& simulation);

}  // namespace palpa::gui
