#pragma once

#include <QComboBox>
#include <QDialog>

#include "app/gui/document/export_body.h"

namespace palpa::gui {

/// What to export: the format, and for triangle meshes which triangles. A mesh body's CAD formats
/// are there but cannot be chosen, with the reason.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// The body of the open project, or one that is not: a project file can hold that, too.
  enum class Subject { kBody, kDeformedSolid };
  ExportDialog(const modeling::Project& project, QWidget* parent, Subject subject = Subject::kBody);

  /// ".step", …
  QString ending() const;
  /// For file dialogs: "STEP (*.step)".
  QString filter() const;
  ExportedSurface surface() const;

 private:
  void update();

  QComboBox* format_;
  QComboBox* surface_;
};

}  // namespace palpa::gui
