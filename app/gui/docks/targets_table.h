#pragma once

#include <QTreeWidget>

#include "app/gui/document/editor.h"
#include "app/gui/document/touch_values.h"

namespace palpa::gui {

/// The targets of the design: touch, present value, wanted value, weight. Delete removes the chosen
/// one.
class TargetsTable : public QTreeWidget {
  Q_OBJECT

 public:
  TargetsTable(Editor& editor, const TouchValues& values, QWidget* parent);

  /// Shows the design of the project; keeps the choice.
  void showTargets();
  /// Number of the chosen target; -1 for none.
  int chosen() const;
  void choose(int target);
  QString text(int row, int column) const;

 Q_SIGNALS:
  void chosenChanged();
  void removalAsked();

 protected:
  bool event(QEvent* event) override;

 private:
  Editor& editor_;
  const TouchValues& values_;
};

}  // namespace palpa::gui
