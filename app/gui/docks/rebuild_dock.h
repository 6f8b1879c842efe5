#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

#include "app/gui/editor.h"

namespace palpa::gui {

/// What the background does: stages with progress, a button to stop, and the facts of the model.
class RebuildDock : public QDockWidget {
  Q_OBJECT

 public:
  RebuildDock(Editor& editor, QWidget* parent);

 private:
  void showStatus();

  Editor& editor_;
  QLabel* state_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* facts_;
};

/// "Up to date", "Building the model: factorise 40 %", …: for the dock and the status bar.
QString rebuildText(const app::RebuildStatus& status);

}  // namespace palpa::gui
