#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>
#include <QTreeWidget>

#include "app/gui/compare/comparison_actions.h"
#include "app/gui/compare/comparison_view.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Panel with the table of a comparison and what the view shows of it.
class ComparisonDock : public QDockWidget {
  Q_OBJECT

 public:
  ComparisonDock(const Workspace& workspace, VariantComparison& comparison,
                 ComparisonView& pictures, ComparisonActions& actions, QWidget* parent);

  /// Text of a cell of the first row with this label below a heading; empty if absent.
  QString text(const QString& heading, const QString& label, int column) const;

 protected:
  /// Ctrl+C copies the table.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum Column { kLabel, kA, kB, kDifference, kPercent, kColumns };

  QWidget* makeStart();
  QWidget* makeContent();
  void showState();
  void showTable();
  void showStatus();
  QString statusText() const;
  QString touchesText() const;
  void copy() const;
  void save();

  Workspace workspace_;
  VariantComparison& comparison_;
  ComparisonView& pictures_;
  ComparisonActions& actions_;
  QStackedWidget* stack_;
  QLabel *names_, *status_;
  QProgressBar* progress_;
  QComboBox* shown_;
  QCheckBox *common_, *deformed_;
  QTreeWidget* table_;
  QPushButton *cancel_, *again_, *reload_, *copy_, *save_, *end_;
};

}  // namespace palpa::gui
