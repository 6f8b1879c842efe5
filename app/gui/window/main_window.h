#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QMainWindow>
#include <QPushButton>
#include <QTimer>
#include <array>

#include "app/gui/actions/file_actions.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/geometry_warnings.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulation_view.h"
#include "app/gui/workspace/tool_box.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/message_bar.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The window: menus, tools, the view, docks and the status bar around one editor.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow();
  ~MainWindow() override;

  Editor& editor() { return editor_; }
  Settings& settings() { return settings_; }
  ViewportWidget& viewport() { return *viewport_; }
  ToolBox& tools() { return tools_; }
  Simulation& simulation() { return simulation_; }
  FileActions& files() { return *files_; }

  /// Opens a project or imports a body, by the ending of the file's name.
  bool openFile(const QString& file) { return files_->openFile(file); }

  /// After the first picture: opens the files of the command line, offers what a crash left, and
  /// welcomes a person who is here for the first time.
  void begin(const QStringList& files);
  void showWelcome();
  MessageBar& messages() { return *messages_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void addTools();
  void addDocks();
  void addDialogs();
  /// The panels and tool bars at their usual places.
  void layOutDocks();
  void addStatusBar();
  void updateTitle();
  void updateStatus();
  /// Says over the view why there is no model, unless that is over in a moment.
  void sayFailure();
  void updateRate();
  void applySettings();

  Settings settings_;
  Editor editor_;
  Simulation simulation_;
  ViewportWidget* viewport_;
  SceneController scene_;
  SimulationView* pictures_;
  GeometryWarnings warnings_;
  Menus menus_;
  ToolBox tools_;
  Workspace workspace_;
  FileActions* files_ = nullptr;
  MessageBar* messages_;
  std::array<QDockWidget*, 5> docks_{};  // model, history, properties, rebuild, forces
  QLabel* hint_;
  QPushButton* rebuild_;
  QLabel* rate_;
  QLabel* frame_;
  QTimer failureTimer_;
  QString failure_;  // that is said over the view
};

}  // namespace palpa::gui
