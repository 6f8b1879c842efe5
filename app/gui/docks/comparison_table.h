#pragma once

#include <QTreeWidget>

#include "app/core/results/comparison.h"
#include "app/gui/base/units.h"

namespace palpa::gui {

/// Table of the figures of two variants, with a line above the figures of each contact, support and
/// of the body. Differences below the estimated errors are grey. Ctrl+C copies the whole table.
class ComparisonTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kLabel, kA, kB, kDifference, kPercent, kColumns };

  explicit ComparisonTable(QWidget* parent);

  /// Fills the table in the given units.
  void showComparison(const app::Comparison& comparison, const ShownUnits& units);
  /// Copies the table to the clipboard, as text with tabs; nothing if it is empty.
  void copy() const;

  /// Text of a cell of the first row with this label below a heading; empty if absent.
  QString text(const QString& heading, const QString& label, int column) const;

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  /// The line with this number, with another one appended if there are not enough.
  QTreeWidgetItem& line(int number);
  void showHeading(QTreeWidgetItem& line, const QString& heading);
  void showRow(QTreeWidgetItem& line, const app::ComparisonRow& row, const ShownUnits& units);
  void showErrors(QTreeWidgetItem& line, const app::Comparison& comparison);
  void makeFigures(QTreeWidgetItem& line);
};

}  // namespace palpa::gui
