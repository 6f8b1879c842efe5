#pragma once

#include <QDockWidget>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <vector>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Panel with the state of the rebuild, its progress with a button to stop, the stages with their
/// times, and the facts of the model.
class RebuildDock : public QDockWidget {
  Q_OBJECT

 public:
  RebuildDock(Editor& editor, QWidget* parent);

 private:
  struct Row {
    Phase phase{};  // of a stage
    QLabel* name;
    QLabel* value;
  };
  Row addRow(QGridLayout& grid, const QString& name, const QString& objectName);
  void makeStages(QGridLayout& grid);
  void makeAccuracy(QGridLayout& grid);
  void makeFacts(QGridLayout& grid);
  void showStatus();
  void showState(const app::RebuildStatus& status);
  void showRemedies();
  void showStages(const app::RebuildStatus& status);
  void showFacts(const app::RebuildStatus& status);

  Editor& editor_;
  QLabel* state_;
  QLabel* details_;
  QProgressBar* progress_;
  QPushButton* stop_;
  QPushButton* again_;
  QWidget* remedies_;
  std::vector<Row> stages_;
  Row total_{};
  QLabel* modelTitle_;
  Row nodes_{}, triangles_{}, angle_{}, memory_{}, condition_{}, balance_{}, requested_{}, error_{};
  Row coefficients_{}, elements_{};
};

}  // namespace palpa::gui
