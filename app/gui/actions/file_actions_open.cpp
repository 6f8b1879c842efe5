#include <QFileInfo>
#include <optional>

#include "app/gui/actions/file_actions.h"
#include "app/gui/actions/import_choice.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/examples.h"
#include "modeling/exchange/file_format.h"

// Opening and importing of FileActions.

namespace palpa::gui {
namespace {

/// None for a file that cannot be opened. Backup copies (backupPath) have the format of their
/// project.
std::optional<modeling::FileFormat> formatToOpen(const QString& file) {
  const bool isBackup = file.endsWith(".bak", Qt::CaseInsensitive);
  const auto format = modeling::fileFormatOf(file.chopped(isBackup ? 4 : 0).toStdString());
  if (!format || !infoOf(*format).canRead) return std::nullopt;
  if (isBackup && format != modeling::FileFormat::kProject) return std::nullopt;
  return format;
}

QString patterns(modeling::FormatFilter accepts) {
  return QString::fromStdString(modeling::endingPatterns(accepts));
}

}  // namespace

bool FileActions::openFile(const QString& file) {
  Editor& editor = workspace_.editor;
  const auto format = formatToOpen(file);
  if (!format) {
    Q_EMIT editor.refused(
        tr("%1 cannot be opened: its name must end in %2")
            .arg(QFileInfo(file).fileName(),
                 QString::fromStdString(modeling::endingsText(modeling::isReadable))));
    return false;
  }
  if (!modeling::isProject(infoOf(*format))) {
    bool needsChoice = false;
    if (!editor.importFile(file, {}, &needsChoice)) return needsChoice && importChosen(file);
  } else if (!editor.open(file)) {
    return false;
  }
  return remember(file);
}

bool FileActions::importChosen(const QString& file) {
  const auto choice = askImportChoice(workspace_, file);
  if (!choice) return false;
  if (choice->takesAll) {
    const QString project = importAllSolids(workspace_, file, *choice);
    return !project.isEmpty() && openFile(project);
  }
  return workspace_.editor.importFile(file, choice->options) && remember(file);
}

bool FileActions::remember(const QString& file) {
  file_ = QFileInfo(file).absoluteFilePath();
  workspace_.settings.addRecentFile(file);
  return true;
}

void FileActions::openDropped(const QStringList& files) {
  if (files.isEmpty()) {
    Q_EMIT workspace_.editor.refused(tr("Only files of this computer can be opened"));
    return;
  }
  if (!mayDiscard() || !openFile(files.front()) || files.size() == 1) return;
  Q_EMIT workspace_.editor.said(
      tr("Of the %1 files that were dropped, the first was opened: %2")
          .arg(QString::number(files.size()), QFileInfo(files.front()).fileName()));
}

bool FileActions::openExample(const QString& name) {
  try {
    workspace_.editor.start(readExample(name));
    return true;
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
    return false;
  }
}

void FileActions::open() {
  if (!mayDiscard()) return;
  const QString file =
      askFileToOpen(workspace_, tr("Open"),
                    tr("All readable files (%1);;Projects (%2);;Copies of before the last save "
                       "(%3);;CAD and meshes (%4);;All files (*)")
                        .arg(patterns(modeling::isReadable), patterns(modeling::isProject),
                             patterns(modeling::isProject).replace(' ', ".bak ") + ".bak",
                             patterns(modeling::isImportable)));
  if (!file.isEmpty()) openFile(file);
}

void FileActions::importBody(bool asks) {
  if (!mayDiscard()) return;
  const QString file = askFileToOpen(
      workspace_, tr("Import"), tr("CAD and meshes (%1)").arg(patterns(modeling::isImportable)));
  if (file.isEmpty()) return;
  if (asks)
    importChosen(file);
  else
    openFile(file);
}

}  // namespace palpa::gui
