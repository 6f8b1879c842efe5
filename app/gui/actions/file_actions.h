#pragma once

#include <QObject>

#include "app/gui/workspace.h"

namespace palpa::gui {

/// The File menu: new, open, recent, save, import, export; asks before edits would be lost.
class FileActions : public QObject {
  Q_OBJECT

 public:
  explicit FileActions(const Workspace& workspace);

  /// Opens a project or imports a body, by the ending of the file's name. Does not ask.
  bool openFile(const QString& file);
  /// Asks what to do with unsaved edits; false when the person wants to stay.
  bool mayDiscard();
  bool save();
  bool saveAs();

 private:
  void makeNewMenu();

  Workspace workspace_;
};

}  // namespace palpa::gui
