#pragma once

#include <QMenu>
#include <QObject>
#include <QStringList>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The File menu: new, open, recent, save, import, export; asks before edits would be lost.
class FileActions : public QObject {
  Q_OBJECT

 public:
  explicit FileActions(const Workspace& workspace);

  /// Opens a project or imports a body, by the ending of the file's name, and remembers it among
  /// the recent files. Does not ask.
  bool openFile(const QString& file);
  /// Opens the first of several files that were dropped; asks before edits would be lost.
  void openDropped(const QStringList& files);
  /// Opens a project of the installation as a new one, by its name in examples().
  bool openExample(const QString& name);
  /// Asks what to do with unsaved edits; false when the person wants to stay.
  bool mayDiscard();
  bool save();
  bool saveAs();
  void newSolid();
  /// Asks for a file and opens it.
  void open();
  /// Asks for a name to write to, which gets `ending` when it has none, and before something is
  /// overwritten; empty when the person cancelled.
  QString askFileToWrite(const QString& title, const QString& filter, const QString& ending);
  /// Asks for a file that exists and keeps its folder; empty when the person cancelled.
  QString askFileToOpen(const QString& title, const QString& filter);

 private:
  void addImportAndExport();
  void addPrimitiveEditing();
  void fillRecentFiles(QMenu* menu);
  void fillExamples(QMenu* menu);
  void recover();
  void importBody();
  void exportBody();
  void savePicture();
  void editPrimitive();

  Workspace workspace_;
};

}  // namespace palpa::gui
