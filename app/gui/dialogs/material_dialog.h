#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/widgets/number_row.h"
#include "modeling/project/project.h"

namespace palpa::gui {

/// The material of the body: from the library with the source of its constants, or own values.
class MaterialDialog : public QDialog {
  Q_OBJECT

 public:
  MaterialDialog(const Settings& settings, const modeling::Material& present, QWidget* parent);

  /// Valid after it was accepted.
  modeling::Material material() const;

 private:
  void fillList();
  void filter(const QString& text);
  void take(int entry);
  void showSource();
  void update();

  const Settings& settings_;
  QLineEdit* filter_;
  QTreeWidget* list_;
  QLabel* source_;
  QLineEdit* name_;
  NumberRow* modulus_;
  NumberRow* ratio_;
  QPushButton* ok_;
  int taken_ = -1;         // the entry of the library that the fields show
  bool isTaking_ = false;  // the fields change because an entry is taken
};

}  // namespace palpa::gui
