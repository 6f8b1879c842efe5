#pragma once

#include <QLabel>
#include <QMainWindow>
#include <memory>

#include "app/gui/editor.h"
#include "app/gui/scene_controller.h"
#include "app/gui/select_tool.h"
#include "app/gui/viewport_widget.h"

namespace palpa::gui {

/// The window: menus, tool bar, the view, docks and the status bar around one editor.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow();

  Editor& editor() { return editor_; }
  ViewportWidget& viewport() { return *viewport_; }

 public Q_SLOTS:
  /// Opens a project or imports a body, by the ending of the file's name.
  bool openFile(const QString& file);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makeFileMenu();
  void makeEditMenu();
  void makeViewMenu();
  void makeHelpMenu();
  void updateTitle();
  void updateActions();
  void updateStatus();
  /// Asks what to do with unsaved edits; false when the person wants to stay.
  bool mayDiscard();
  bool save();
  bool saveAs();
  void setDark(bool dark);

  Editor editor_;
  ViewportWidget* viewport_;
  SceneController scene_;
  SelectTool selectTool_;
  QAction* undo_ = nullptr;
  QAction* redo_ = nullptr;
  QLabel* hint_;
  QLabel* rebuild_;
  QLabel* frame_;
};

}  // namespace palpa::gui
