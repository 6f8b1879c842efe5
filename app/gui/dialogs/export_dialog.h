#pragma once

#include <QComboBox>
#include <QDialog>

#include "app/gui/document/export_body.h"
#include "modeling/exchange/file_format.h"

namespace palpa::gui {

/// Choice of the format and, for triangle meshes, of the triangles. For mesh bodies the CAD formats
/// are disabled, and a note states the reason.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// The body of the open project, or its deformed shape, which can also be exported as a project.
  enum class Subject { kBody, kDeformedSolid };
  ExportDialog(const modeling::Project& project, QWidget* parent, Subject subject = Subject::kBody);

  /// ".step", …
  QString ending() const;
  /// Filter for file dialogs: "STEP (*.step)".
  QString filter() const;
  ExportedSurface surface() const;

 private:
  const modeling::FileFormatInfo& format() const;
  void update();

  QComboBox* format_;
  QComboBox* surface_;
};

}  // namespace palpa::gui
