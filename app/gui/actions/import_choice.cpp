#include "app/gui/actions/import_choice.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <algorithm>

#include "app/core/session/import_all.h"
#include "app/gui/base/background_job.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/import_dialog.h"
#include "app/gui/document/editor.h"

namespace palpa::gui {
namespace {

/// Asks before existing files are replaced.
bool mayReplace(const std::vector<std::filesystem::path>& files, QWidget& window) {
  const auto existing =
      std::count_if(files.begin(), files.end(), [](const std::filesystem::path& file) {
        std::error_code code;
        return std::filesystem::exists(file, code);
      });
  if (existing == 0) return true;
  return QMessageBox::question(&window, tr("Import all"),
                               tr("%1 of the %2 project files exist already. Replace them?")
                                   .arg(existing)
                                   .arg(files.size())) == QMessageBox::Yes;
}

}  // namespace

std::optional<ImportChoice> askImportChoice(const Workspace& workspace, const QString& file) {
  try {
    auto found = runInBackground(
        workspace.window, tr("Reading %1").arg(QFileInfo(file).fileName()), [&](const Job& job) {
          return modeling::listBodies(file.toStdString(), {}, modeling::ListedSurface::kCoarse,
                                      job);
        });
    if (!found) return std::nullopt;
    ImportDialog dialog(workspace.settings, file, *found, &workspace.window);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return ImportChoice{dialog.options(), std::move(*found), dialog.current(), dialog.takesAll()};
  } catch (const std::exception& error) {
    Q_EMIT workspace.editor.refused(QString::fromStdString(error.what()));
    return std::nullopt;
  }
}

QString importAllSolids(const Workspace& workspace, const QString& file,
                        const ImportChoice& choice) {
  const QString folder = QFileDialog::getExistingDirectory(
      &workspace.window, tr("Folder for the project files"), workspace.settings.lastFolder());
  if (folder.isEmpty()) return {};
  workspace.settings.setLastFolder(folder);
  const auto files = app::projectFiles(choice.found, folder.toStdString());
  if (!mayReplace(files, workspace.window)) return {};
  try {
    const auto saved = runInBackground(
        workspace.window, tr("Importing %1").arg(QFileInfo(file).fileName()), [&](const Job& job) {
          return app::importAll(file.toStdString(), choice.found, choice.options, files, job);
        });
    if (!saved) return {};
    qsizetype written = 0;
    for (const app::SavedBody& body : *saved) {
      if (body.problem.empty())
        ++written;
      else
        Q_EMIT workspace.editor.refused(QString::fromStdString(body.problem));
    }
    Q_EMIT workspace.editor.said(
        tr("%1 of %2 solids were written to %3").arg(written).arg(saved->size()).arg(folder));
    const app::SavedBody& current = saved->at(choice.current);
    return current.problem.empty() ? QString::fromStdString(current.file.string()) : QString();
  } catch (const std::exception& error) {
    Q_EMIT workspace.editor.refused(QString::fromStdString(error.what()));
    return {};
  }
}

}  // namespace palpa::gui
