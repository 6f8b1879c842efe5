#pragma once

#include <QString>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Asks for a name to write to. A name without `ending` gets it. Asks before a file is overwritten.
/// Empty if the user cancelled.
QString askFileToWrite(const Workspace& workspace, const QString& title, const QString& filter,
                       const QString& ending);

/// Asks for an existing file and remembers its folder. Empty if the user cancelled.
QString askFileToOpen(const Workspace& workspace, const QString& title, const QString& filter);

}  // namespace palpa::gui
