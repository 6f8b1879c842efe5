#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/shapes/shape_sketch.h"

namespace palpa::gui {

/// Asks for a file and reads profiles from it: the curve chosen in an ImportProfileDialog for a
/// drawing, or all sections of a profile file. Nothing if the user cancelled. Throws ModelingError
/// for a file that cannot be read.
std::optional<std::vector<modeling::SketchSection>> importSections(Settings& settings,
                                                                   modeling::SketchUse use,
                                                                   QWidget& window);

/// The paths of a drawing, one of which is chosen.
class DrawingView : public QWidget {
  Q_OBJECT

 public:
  explicit DrawingView(QWidget* parent);

  void setPaths(const std::vector<modeling::DrawnPath>& paths);
  void setChosen(int path, const std::optional<modeling::ProfileCurve>& fitted);

 Q_SIGNALS:
  void picked(int path);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  QPointF pixelOf(const Eigen::Vector2d& at) const;

  std::vector<QPolygonF> lines_;  // mm
  QPolygonF fitted_;
  int chosen_ = -1;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = Eigen::Vector2d::Zero();
};

/// Choice of a curve of a drawing, and of the tolerance of the spline through it.
class ImportProfileDialog : public QDialog {
  Q_OBJECT

 public:
  ImportProfileDialog(Settings& settings, modeling::SketchUse use, modeling::ProfileDrawing drawing,
                      QWidget* parent);

  /// Valid after the dialog was accepted.
  modeling::ProfileCurve curve() const;

  void accept() override;

 private:
  enum Position { kAsDrawn, kCentred, kAtAxis };
  void showLayer();
  void fit();

  Settings& settings_;
  modeling::SketchUse use_;
  modeling::ProfileDrawing drawing_;
  DrawingView* view_;
  QComboBox* layer_;
  QListWidget* paths_;
  QComboBox* position_;
  QuantityEdit* tolerance_;
  QCheckBox* smooths_;
  QSpinBox* angle_;
  QLabel* result_;
  QLabel* problem_;
  QPushButton* ok_;
  std::optional<modeling::FittedProfile> fitted_;
};

}  // namespace palpa::gui
