#pragma once

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Adds the entries of the Solid menu that edit the shape from which the solid was made: its sizes
/// and its profile. They are enabled while the solid is such a shape.
void addPrimitiveActions(const Workspace& workspace);

}  // namespace palpa::gui
