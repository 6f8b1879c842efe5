#pragma once

#include <QList>
#include <QString>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// A kind of file that can be written.
struct WrittenKind {
  QString filter;  ///< for the dialog: "Tables (*.csv)"
  QString ending;  ///< ".csv"
};

/// Asks for a name to write to, and the kind. A name without the ending of any kind gets the ending
/// of the chosen one, so that the ending tells the kind. Asks before a file is overwritten. Empty
/// if the user cancelled.
QString askFileToWrite(const Workspace& workspace, const QString& title,
                       const QList<WrittenKind>& kinds);

/// The same for one kind.
QString askFileToWrite(const Workspace& workspace, const QString& title, const QString& filter,
                       const QString& ending);

/// Asks for an existing file and remembers its folder. Empty if the user cancelled.
QString askFileToOpen(const Workspace& workspace, const QString& title, const QString& filter);

}  // namespace palpa::gui
