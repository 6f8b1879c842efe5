#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <optional>

#include "app/gui/widgets/number_row.h"
#include "app/gui/workspace/workspace.h"
#include "modeling/project/project.h"

namespace palpa::gui {

/// Choice of the material: from the library, with the source of its constants, or with typed
/// values.
class MaterialDialog : public QDialog {
  Q_OBJECT

 public:
  MaterialDialog(const Settings& settings, const modeling::Material& present, QWidget* parent);

  /// Valid after the dialog was accepted.
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
  int taken_ = -1;                 // library entry in the fields
  bool isTaking_ = false;          // take() is changing the fields
  std::optional<double> density_;  // kg/m^3, of the present or taken material
};

/// Asks for the material of the project and sets it.
void editMaterial(const Workspace& workspace);

}  // namespace palpa::gui
