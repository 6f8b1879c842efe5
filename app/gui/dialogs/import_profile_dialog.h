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
#include "app/gui/dialogs/drawing_view.h"
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

/// Choice of a curve of a drawing, and of the tolerance of the spline through it. Reads and fits in
/// the background: a click waits for the result, or for Cancel.
class ImportProfileDialog : public QDialog {
  Q_OBJECT

 public:
  ImportProfileDialog(Settings& settings, modeling::SketchUse use, modeling::ProfileDrawing drawing,
                      QWidget* parent);  // not null: reading may take long before this is shown

  /// Valid after the dialog was accepted.
  modeling::ProfileCurve curve() const;

  void accept() override;

 private:
  enum Position { kAsDrawn, kCentred, kAtAxis };
  void readLayer();
  void showPaths();
  void fit();
  void showFitted(int path);
  /// Widget over which the progress of a job is shown.
  QWidget& jobParent() { return isVisible() ? *this : *parentWidget(); }

  Settings& settings_;
  modeling::SketchUse use_;
  modeling::ProfileDrawing drawing_;
  DrawingView* view_;
  QComboBox* layer_;
  int readLayer_ = 0;  // index in layer_ of the layer in drawing_
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
