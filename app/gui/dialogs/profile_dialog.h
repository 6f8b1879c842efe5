#pragma once

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QToolBar>

#include "app/gui/base/settings.h"
#include "app/gui/dialogs/profile_canvas.h"
#include "app/gui/dialogs/shape_preview.h"
#include "app/gui/dialogs/sketch_editor.h"
#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Draws and edits the profiles of a revolved, extruded or lofted shape, beside a picture of the
/// solid. Escape in fields and in the plane cancels there first; Enter never closes the dialog,
/// Ctrl+Enter does.
class ProfileDialog : public QDialog {
  Q_OBJECT

 public:
  /// For a shape with modeling::hasProfile().
  ProfileDialog(Settings& settings, const modeling::Primitive& primitive, QWidget* parent);

  /// Valid after the dialog was accepted.
  const modeling::Primitive& primitive() const { return primitive_; }

  void accept() override;
  void reject() override;

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QAction* addTool(const QString& picture, const QString& text, const QKeySequence& keys,
                   const QString& tip, const std::function<void()>& work);
  void showIconOnly(QAction* action);
  void addTools();
  void addSnapping();
  QWidget* makeSections();
  QWidget* makeNumbers();
  void refresh();
  void refreshSections();
  void refreshNumbers();
  void showProblem(const QString& problem);
  void setCoordinate(int axis, double value);
  void import();
  void exportSvg();

  Settings& settings_;
  modeling::Primitive primitive_;
  SketchEditor editor_;
  QToolBar* tools_;
  ProfileCanvas* canvas_;
  ShapePreview* preview_;
  QTableWidget* sections_ = nullptr;
  QPushButton* removeSection_ = nullptr;
  QLabel* selected_;
  std::array<QuantityEdit*, 2> coordinates_{};
  std::array<QuantityEdit*, 2> extents_{};
  QCheckBox* corner_;
  QLabel* pointer_;
  QLabel* problem_;
  QPushButton* ok_;
  QAction *draw_ = nullptr, *drawsCorners_ = nullptr, *undo_ = nullptr, *redo_ = nullptr;
  QAction *delete_ = nullptr, *insert_ = nullptr, *close_ = nullptr;
  bool isRefreshing_ = false;
};

/// Edits the profiles of the project's primitive, which must have some; one step of the project.
void editProfileOfProject(const Workspace& workspace);

}  // namespace palpa::gui
