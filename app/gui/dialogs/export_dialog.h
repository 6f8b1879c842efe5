#pragma once

#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QSpinBox>

#include "app/core/page/make_touch_page.h"
#include "app/gui/document/export_body.h"
#include "modeling/exchange/file_format.h"

namespace palpa::gui {

/// Choice of the format and, for triangle meshes, of the triangles, or for a page that can be
/// touched, of the number of touch places and the size. For mesh bodies the CAD formats
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
  app::TouchPageSettings page() const;

 private:
  const modeling::FileFormatInfo& format() const;
  void update();

  QComboBox* format_;
  QComboBox* surface_;
  QSpinBox* places_;
  QSpinBox* size_;
  QFormLayout* form_;
};

}  // namespace palpa::gui
