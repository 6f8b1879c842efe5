#pragma once

#include <QDockWidget>
#include <QListWidget>
#include <QTimer>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Panel with the steps of the history. A click or Enter goes to a step.
class HistoryDock : public QDockWidget {
  Q_OBJECT

 public:
  HistoryDock(Editor& editor, QWidget* parent);

 private:
  void showHistory();

  Editor& editor_;
  QListWidget* list_;
  QTimer soon_;
};

}  // namespace palpa::gui
