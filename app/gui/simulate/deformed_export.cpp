#include "app/gui/simulate/deformed_export.h"

#include <QFileInfo>

#include "app/core/results/deformed_solid.h"
#include "app/gui/base/background_job.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/export_dialog.h"
#include "app/gui/dialogs/file_dialogs.h"

namespace palpa::gui {
void exportDeformed(const Workspace& workspace, Simulation& simulation) {
  const auto state = simulation.describe();
  if (!state) {
    Q_EMIT workspace.editor.refused(tr("The model is not ready yet; try again in a moment."));
    return;
  }
  const auto model = simulation.body()->sharedModel();
  try {
    // Before the dialog: fails for models of triangles.
    const modeling::Project deformed =
        app::deformedProject(workspace.editor.project(), *model, state->field);
    ExportDialog dialog(deformed, &workspace.window, ExportDialog::Subject::kDeformedSolid);
    if (dialog.exec() != QDialog::Accepted) return;
    const QString file =
        askFileToWrite(workspace, dialog.windowTitle(), dialog.filter(), dialog.ending());
    if (file.isEmpty()) return;
    const bool isDone = runWorkInBackground(
        workspace.window, tr("Exporting %1").arg(QFileInfo(file).fileName()),
        [&](const Job& job) { exportBody(deformed, file.toStdString(), dialog.surface(), job); });
    if (!isDone) return;
    QString words = tr("The deformed solid was exported to %1").arg(file);
    if (simulation.scale() != 1) words += tr("; its displacements are the true ones, as × 1");
    Q_EMIT workspace.editor.said(words);
  } catch (const std::exception& error) {
    Q_EMIT workspace.editor.refused(QString::fromStdString(error.what()));
  }
}

}  // namespace palpa::gui
