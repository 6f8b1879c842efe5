#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <optional>

#include "app/gui/dialogs/material_list.h"
#include "app/gui/document/own_materials.h"
#include "app/gui/widgets/number_row.h"
#include "app/gui/workspace/workspace.h"
#include "modeling/project/project.h"

class QFormLayout;

namespace palpa::gui {

/// Choice of the material: from the user's own materials and the library, with the source of the
/// constants, or with typed values. Own materials are saved, renamed and deleted here; this is kept
/// even if the dialog is cancelled.
class MaterialDialog : public QDialog {
  Q_OBJECT

 public:
  MaterialDialog(Settings& settings, const modeling::Material& present, QWidget* parent);

  /// Valid after the dialog was accepted.
  modeling::Material material() const;
  /// Puts the keyboard focus into the field for the density.
  void enterDensity();

 private:
  QLayout* makeOwnButtons();
  QFormLayout* makeForm();
  QPushButton* addOwnButton(QLayout& line, const QString& name, const QString& text,
                            const QString& tip);
  void connectFields();
  /// Puts a material into the fields.
  void take(const modeling::LibraryMaterial& entry);
  void showSource();
  void update();
  void applyHardness();
  /// Reason why the fields cannot be saved as an own material; empty if they can.
  QString obstacleToSave() const;
  void saveOwn();
  void renameOwn(const std::string& from, const QString& to);
  void deleteOwn();
  bool holds(const modeling::Material& material) const;

  const Settings& settings_;
  OwnMaterials own_;
  MaterialList* list_;
  QLabel* source_;
  QLineEdit* name_;
  NumberRow* modulus_;
  NumberRow* hardness_;
  NumberRow* ratio_;
  NumberRow* density_;
  QLineEdit* note_;
  QPushButton *save_ = nullptr, *rename_ = nullptr, *delete_ = nullptr, *ok_ = nullptr;
  std::optional<modeling::LibraryMaterial> taken_;  // list entry in the fields
  QString hardnessNote_;                            // source of a modulus from the hardness
  bool isTaking_ = false;                           // take() or applyHardness() changes the fields
};

/// Asks for the material of the project and sets it.
void editMaterial(const Workspace& workspace, bool isForDensity = false);

}  // namespace palpa::gui
