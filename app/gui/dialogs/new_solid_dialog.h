#pragma once

#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/dialogs/fit_measurement.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/number_row.h"
#include "modeling/shapes/primitive.h"

namespace palpa::gui {

/// Choice of a shape and its sizes, with a preview that follows every keystroke.
class NewSolidDialog : public QDialog {
  Q_OBJECT

 public:
  /// With `present` the dialog edits the sizes of an existing shape.
  NewSolidDialog(Settings& settings, const std::optional<modeling::Primitive>& present,
                 QWidget* parent);

  /// Valid after the dialog was accepted.
  const modeling::Primitive& primitive() const { return primitive_; }
  QString shapeTitle() const;

 private:
  void addWidgets(bool isPresent);
  void showKind(int kind);
  void addProfileRow();
  void chooseProfile(int index);
  void readFields();
  void update();
  void showSolid(const modeling::Solid& solid);
  void setMakable(bool isMakable);
  void showProblem(const QString& problem);

  Settings& settings_;
  modeling::Primitive primitive_;
  QListWidget* kinds_;
  QWidget* sizes_ = nullptr;
  QFormLayout* form_ = nullptr;
  std::vector<NumberRow*> lengths_;
  QComboBox* profile_ = nullptr;
  QSpinBox* degree_;
  QSpinBox* controlPoints_;
  ViewportWidget* preview_;
  QLabel* stale_;  // covers the preview while the sizes give no solid
  QLabel* facts_;
  QLabel* problem_;
  QPushButton* ok_;
  FitMeasurement fit_;
  QString expected_;
  int shownKind_ = -1;
  bool isFresh_ = true;  // reset the camera for the next solid
};

}  // namespace palpa::gui
