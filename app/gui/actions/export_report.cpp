#include "app/gui/actions/export_report.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <exception>
#include <optional>

#include "app/core/results/touch_study.h"
#include "app/gui/base/background_job.h"
#include "app/gui/base/canvas.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/report_pdf.h"
#include "app/report/touch_report.h"
#include "base/atomic_file.h"

namespace palpa::gui {
namespace {

/// The shown model if it is complete and belongs to the present project; null otherwise.
std::shared_ptr<const app::TouchModel> presentModel(const Editor& editor) {
  const app::RebuildStatus status = editor.rebuildStatus();
  const bool isPresent = status.state == app::RebuildStatus::State::kUpToDate &&
                         status.modelRevision == status.revision && !status.residual;
  return isPresent ? editor.model() : nullptr;
}

report::ReportSource sourceOf(const Editor& editor) {
  report::ReportSource source;
  source.file = QFileInfo(editor.fileName()).fileName().toStdString();
  if (!source.file.empty() && editor.session().isModified()) source.file += " with unsaved changes";
  source.version = QCoreApplication::applicationVersion().toStdString();
  source.date = report::dateNow();
  return source;
}

/// Bytes of PNG files; none if the user cancelled.
std::optional<std::vector<std::string>> draw(const Workspace& workspace,
                                             const std::vector<report::ReportPicture>& pictures) {
  Canvas canvas;
  if (!canvas.isValid())
    throw FileError(tr("Pictures cannot be drawn without OpenGL 3.2.").toStdString());
  std::vector<std::string> files;
  const bool isDrawn =
      runInSteps(workspace.window, tr("Drawing the pictures"), pictures.size(), [&](std::size_t k) {
        canvas.makeCurrent();
        files.push_back(
            view::pictureBytes(pictures[k].picture, report::kReportPictureSize, canvas.window()));
      });
  if (!isDrawn) return std::nullopt;
  return files;
}

/// False if the user cancelled.
bool writeReport(const Workspace& workspace, const QString& path) {
  AtomicFile file(path.toStdString());  // fails before the long work if it cannot be written
  const modeling::Project project = workspace.editor.project();
  const report::ReportSource source = sourceOf(workspace.editor);
  std::optional<app::TouchStudy> study;
  std::vector<report::ReportPicture> pictures;
  const bool isPlayed =
      runWorkInBackground(workspace.window, tr("Exporting %1").arg(QFileInfo(path).fileName()),
                          [&, model = presentModel(workspace.editor)](const Job& job) {
                            study = app::makeTouchStudy(project, model, job);
                            job.throwIfCancelled();
                            pictures = report::reportPictures(*study);
                          });
  if (!isPlayed) return false;
  const auto files = draw(workspace, pictures);
  if (!files) return false;
  if (path.endsWith(".pdf", Qt::CaseInsensitive))
    writeReportPdf(report::reportBody(*study, source, pictures), *files, project.name,
                   file.freshPath());
  else
    file.write(report::reportDocument(*study, source, pictures, *files));
  file.commit();
  return true;
}

}  // namespace

void exportReport(const Workspace& workspace) {
  if (isBackgroundJobRunning()) return;
  Editor& editor = workspace.editor;
  if (!report::isReportable(editor.project())) {
    Q_EMIT editor.refused(
        tr("There is nothing to report: the project has no touches and no loads. Record a touch "
           "with Place touch, or add a load."));
    return;
  }
  const QString file =
      askFileToWrite(workspace, tr("Export report"),
                     {{tr("Web page (*.html)"), ".html"}, {tr("PDF (*.pdf)"), ".pdf"}});
  if (file.isEmpty()) return;
  try {
    if (writeReport(workspace, file)) Q_EMIT editor.said(tr("Report exported to %1").arg(file));
  } catch (const std::exception& error) {
    Q_EMIT editor.refused(QString::fromStdString(error.what()));
  }
}

}  // namespace palpa::gui
