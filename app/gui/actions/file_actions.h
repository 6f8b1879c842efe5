#pragma once

#include <QMenu>
#include <QObject>
#include <QStringList>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The File menu: new, open, recent, save, import, export. Asks before edits would be lost.
class FileActions : public QObject {
  Q_OBJECT

 public:
  explicit FileActions(const Workspace& workspace);

  /// Opens a project or imports a body, by the ending of the name, and adds it to the recent files.
  /// Asks only which of several solids to import.
  bool openFile(const QString& file);
  /// Opens the first of several dropped files. Asks before edits would be lost.
  void openDropped(const QStringList& files);
  /// Opens an example as a new project, by its name in examples().
  bool openExample(const QString& name);
  /// Applies unfinished input and asks what to do with unsaved edits; false if the user cancels.
  bool mayDiscard();
  bool save();
  bool saveAs();
  void newSolid();
  /// Asks for a file and opens it.
  void open();
  /// Shows the welcome dialog and does what the user chose there.
  void showWelcome();
  /// Stores a picture of the view for the welcome dialog, if the project is as in its file.
  void storeThumbnail();

 private:
  void addImportAndExport();
  void fillRecentFiles(QMenu* menu);
  void fillExamples(QMenu* menu);
  void recover();
  /// Asks for a file; with `asks` also for its solid, unit, scale and orientation.
  void importBody(bool asks);
  /// Asks which solid of a file to import and how; imports it, or all into project files.
  bool importChosen(const QString& file);
  /// Adds the open file to the recent ones; true.
  bool remember(const QString& file);
  void exportBody();
  void savePicture();

  Workspace workspace_;
  QString file_;  // the file that was opened, imported or saved last; empty for another project
};

}  // namespace palpa::gui
