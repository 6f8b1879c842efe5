#pragma once

#include "app/gui/simulate/simulation.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Asks for a format and a file and writes the present deformed shape: patches as a project or CAD
/// file, or triangles. Editor::refused states why it is impossible (a model of triangles, no
/// model).
void exportDeformed(const Workspace& workspace, Simulation& simulation);

}  // namespace palpa::gui
