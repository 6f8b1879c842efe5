#pragma once

#include <QDialog>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/document/selection_sets.h"

namespace palpa::gui {

/// List of the named selections: select, rename, name again, delete.
class SelectionSetsDialog : public QDialog {
  Q_OBJECT

 public:
  SelectionSetsDialog(SelectionSets& sets, QWidget* parent);

 private:
  void fill();
  QString chosen() const;
  QPushButton* addButton(const QString& name, const QString& text, const QString& tip);
  void update();

  SelectionSets& sets_;
  QTreeWidget* list_;
  QWidget* buttons_;
  QPushButton *select_, *add_, *replace_, *rename_, *remove_;
  bool isFilling_ = false;
};

}  // namespace palpa::gui
