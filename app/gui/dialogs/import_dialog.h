#pragma once

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QTreeWidget>

#include "app/gui/base/settings.h"
#include "app/gui/dialogs/bodies_preview.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/exchange/cad_import.h"

namespace palpa::gui {

/// Choice of a solid of a file, of its unit, scale and orientation. The sizes and the picture show
/// the placed solids.
class ImportDialog : public QDialog {
  Q_OBJECT

 public:
  /// `found` with coarse surfaces and without a placement.
  ImportDialog(Settings& settings, const QString& file, modeling::FileBodies found,
               QWidget* parent);

  /// Valid after the dialog was accepted.
  modeling::ImportOptions options() const;
  /// The user wants a project for each solid; options() then has the current one.
  bool takesAll() const { return takesAll_; }
  std::size_t current() const;

 private:
  enum Column { kNumber, kName, kSize, kParts, kColumns };
  void addUnits();
  QWidget* makeForm();
  QWidget* makeButtons();
  modeling::ImportPlacement placement() const;
  void place();
  void showCurrent();

  Settings& settings_;
  modeling::FileBodies found_;
  modeling::FileBodies placed_;
  QTreeWidget* solids_;
  QComboBox* unit_;
  QuantityEdit* scale_;
  QComboBox* up_;
  QLabel* result_;
  QLabel* problem_;
  BodiesPreview* preview_;
  bool takesAll_ = false;
};

}  // namespace palpa::gui
