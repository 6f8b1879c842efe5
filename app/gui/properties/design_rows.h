#pragma once

#include "app/gui/document/editor.h"
#include "app/gui/document/touch_values.h"
#include "app/gui/properties/property_page.h"

// Rows of the Targets panel: pages that edit the design of the project.
namespace palpa::gui {

/// Identifies the rows of the target with this number; empty for none. While the key is the same,
/// the page stays and only its values change.
QString targetKey(const Editor& editor, int target);
/// Rows of a target: touch, wanted stiffness or force, depth, weight.
void addTargetRows(PropertyPage& page, int target, const TouchValues& values);

/// The same for the rest of the design.
QString motionKey(const Editor& editor);
/// Rows for the points that may move, directions, limits and symmetry.
void addMotionRows(PropertyPage& page);

}  // namespace palpa::gui
