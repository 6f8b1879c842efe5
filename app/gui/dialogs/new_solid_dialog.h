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
#include "app/gui/dialogs/shape_preview.h"
#include "app/gui/widgets/number_row.h"
#include "app/gui/widgets/vector_edit.h"
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
  void editProfile();
  /// Takes a primitive with a profile that is not in the list.
  void setProfile(const modeling::Primitive& primitive);
  void addOuterSizeRow();
  void showOuterSize();
  void setOuterSize(const Eigen::Vector3d& size);
  void showLengths();
  void readFields();
  void update();
  void setMakable(bool isMakable);
  void showProblem(const QString& problem);

  Settings& settings_;
  modeling::Primitive primitive_;
  QListWidget* kinds_;
  QFormLayout* form_ = nullptr;
  std::vector<NumberRow*> lengths_;
  QComboBox* profile_ = nullptr;
  QPushButton* editProfile_ = nullptr;
  /// Shape with the profile that is not in the list: drawn, imported, or as it was.
  std::optional<decltype(modeling::Primitive::shape)> ownShape_;
  VectorEdit* outerSize_ = nullptr;
  Eigen::Vector3d shownOuterSize_ = Eigen::Vector3d::Zero();  // mm
  QSpinBox* degree_;
  QSpinBox* controlPoints_;
  ShapePreview* preview_;
  QLabel* facts_;
  QLabel* problem_;
  QPushButton* ok_;
  FitMeasurement fit_;
  QString expected_;
  int shownKind_ = -1;
};

}  // namespace palpa::gui
