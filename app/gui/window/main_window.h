#pragma once

#include <QLabel>
#include <QMainWindow>
#include <QPushButton>
#include <QTimer>
#include <memory>

#include "app/gui/actions/file_actions.h"
#include "app/gui/base/settings.h"
#include "app/gui/compare/comparison_actions.h"
#include "app/gui/compare/comparison_view.h"
#include "app/gui/compare/found_shape_view.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/shape_finder.h"
#include "app/gui/simulate/gradient_view.h"
#include "app/gui/simulate/samples.h"
#include "app/gui/simulate/section_view.h"
#include "app/gui/simulate/simulation_view.h"
#include "app/gui/view/geometry_warnings.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/message_bar.h"
#include "app/gui/window/dock_list.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

class KeyboardFocus;

/// The window: menus, tools, view, panels and status bar for one editor.
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
  SectionView& section() { return *section_; }
  Samples& samples() { return *samples_; }
  GradientView& gradientView() { return *gradientView_; }
  VariantComparison& comparison() { return comparison_; }
  ComparisonView& comparisonView() { return *comparisonView_; }
  ComparisonActions& comparisonActions() { return *comparisonActions_; }
  ShapeFinder& shapeFinder() { return *finder_; }
  const FoundShapeView& foundShapeView() const { return *foundShape_; }
  FileActions& files() { return *files_; }

  /// Opens a project or imports a body, by the ending of the name.
  bool openFile(const QString& file) { return files_->openFile(file); }

  /// Call after the first picture: opens the file of the command line, offers snapshots of a
  /// crashed session, and shows the welcome dialog at the first start or if there are recent files.
  void begin(const QStringList& files);
  MessageBar& messages() { return *messages_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void addTools();
  void addDocks();
  void addDialogs();
  /// Puts panels and tool bars at their usual places.
  void resetLayout();
  void addStatusBar();
  void updateTitle();
  void updateStatus();
  void updateRate();
  void applySettings();

  Settings settings_;
  Editor editor_;
  Simulation simulation_;
  VariantComparison comparison_;
  ShapeFinder* finder_;  // owned by the editor
  ViewportWidget* viewport_;
  SceneController scene_;
  SimulationView* pictures_;
  SectionView* section_;
  Samples* samples_;
  GradientView* gradientView_;
  ComparisonView* comparisonView_;
  FoundShapeView* foundShape_;
  GeometryWarnings warnings_;
  Menus menus_;
  ToolBox tools_;
  Workspace workspace_;
  FileActions* files_ = nullptr;
  ComparisonActions* comparisonActions_ = nullptr;
  MessageBar* messages_;
  QLabel* hint_;
  QPushButton* rebuild_;
  QLabel* rate_;
  QLabel* frame_;
  DockList docks_;  // panels write to the members above until they are deleted
  std::unique_ptr<KeyboardFocus> keyboard_;  // the last member: must not outlive panels and view
};

}  // namespace palpa::gui
