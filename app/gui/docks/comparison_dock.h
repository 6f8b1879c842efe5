#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>

#include "app/gui/compare/comparison_actions.h"
#include "app/gui/compare/comparison_view.h"
#include "app/gui/docks/comparison_table.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Panel with the table of a comparison and the choice of its pictures in the view.
class ComparisonDock : public QDockWidget {
  Q_OBJECT

 public:
  ComparisonDock(const Workspace& workspace, VariantComparison& comparison,
                 ComparisonView& pictures, ComparisonActions& actions, QWidget* parent);

  /// See ComparisonTable::text().
  QString text(const QString& heading, const QString& label, int column) const {
    return table_->text(heading, label, column);
  }

 private:
  QWidget* makeStart();
  QWidget* makeContent();
  void showState();
  void showTable();
  void showStatus();
  QString statusText() const;
  QString touchesText() const;
  void exportTable();

  Workspace workspace_;
  VariantComparison& comparison_;
  ComparisonView& pictures_;
  ComparisonActions& actions_;
  QStackedWidget* stack_;
  QLabel *names_, *status_;
  QProgressBar* progress_;
  QComboBox* shown_;
  QCheckBox *common_, *deformed_;
  ComparisonTable* table_;
  QPushButton *cancel_, *again_, *reload_, *copy_, *export_, *end_;
};

}  // namespace palpa::gui
