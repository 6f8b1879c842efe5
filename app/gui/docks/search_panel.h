#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QWidget>

#include "app/gui/base/settings.h"
#include "app/gui/document/shape_finder.h"
#include "app/gui/widgets/plot_widget.h"

namespace palpa::gui {

/// A running search and its result: progress, the targets' values over the steps, numbers before
/// and after, what limits it, and the buttons that stop, accept or discard.
class SearchPanel : public QWidget {
  Q_OBJECT

 public:
  SearchPanel(ShapeFinder& finder, const Settings& settings, QWidget* parent);

  /// Cell of the table of numbers.
  QString text(int row, int column) const;

 private:
  void update();
  void showState();
  void showPlot();
  void showNumbers();
  QString stateText() const;

  ShapeFinder& finder_;
  const Settings& settings_;
  QLabel *state_, *details_;
  QProgressBar* progress_;
  PlotWidget* plot_;
  QTableWidget* numbers_;
  QPushButton *stop_, *accept_, *discard_;
};

}  // namespace palpa::gui
