#include "app/gui/dialogs/file_dialogs.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <algorithm>

#include "app/gui/document/editor.h"

namespace palpa::gui {

QString askFileToOpen(const Workspace& workspace, const QString& title, const QString& filter) {
  const QString file = QFileDialog::getOpenFileName(&workspace.window, title,
                                                    workspace.settings.lastFolder(), filter);
  if (!file.isEmpty()) workspace.settings.setLastFolder(QFileInfo(file).absolutePath());
  return file;
}

QString askFileToWrite(const Workspace& workspace, const QString& title,
                       const QList<WrittenKind>& kinds) {
  QStringList filters;
  for (const WrittenKind& kind : kinds) filters << kind.filter;
  QFileDialog dialog(&workspace.window, title, workspace.settings.lastFolder(), filters.join(";;"));
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  const auto chosenEnding = [&] {
    const qsizetype chosen = filters.indexOf(dialog.selectedNameFilter());
    return kinds.at(std::max<qsizetype>(chosen, 0)).ending;
  };
  dialog.setDefaultSuffix(chosenEnding());  // set before the dialog asks about overwriting
  const QString present = workspace.editor.fileName();
  QString name = present.isEmpty() ? QString::fromStdString(workspace.editor.project().name)
                                   : QFileInfo(present).completeBaseName();
  if (!present.isEmpty()) dialog.setDirectory(QFileInfo(present).absolutePath());
  dialog.selectFile(name.replace('/', '-') + chosenEnding());
  QObject::connect(&dialog, &QFileDialog::filterSelected, &dialog, [&] {
    dialog.setDefaultSuffix(chosenEnding());
    const QFileInfo typed(dialog.selectedFiles().value(0));
    const bool isKnown = std::any_of(kinds.begin(), kinds.end(), [&](const WrittenKind& kind) {
      return typed.fileName().endsWith(kind.ending, Qt::CaseInsensitive);
    });
    if (isKnown) dialog.selectFile(typed.completeBaseName() + chosenEnding());
  });
  if (dialog.exec() != QDialog::Accepted) return {};
  QString file = dialog.selectedFiles().value(0);
  // The ending decides the format: another ending would write another format or none.
  const bool hasEnding = std::any_of(kinds.begin(), kinds.end(), [&](const WrittenKind& kind) {
    return file.endsWith(kind.ending, Qt::CaseInsensitive);
  });
  if (!hasEnding) {
    file += chosenEnding();
    const QString question =
        QCoreApplication::translate("FileDialogs", "%1 exists already. Replace it?");
    if (QFileInfo::exists(file) &&
        QMessageBox::question(&workspace.window, title, question.arg(QFileInfo(file).fileName())) !=
            QMessageBox::Yes)
      return {};
  }
  workspace.settings.setLastFolder(QFileInfo(file).absolutePath());
  return file;
}

QString askFileToWrite(const Workspace& workspace, const QString& title, const QString& filter,
                       const QString& ending) {
  return askFileToWrite(workspace, title, QList<WrittenKind>{{filter, ending}});
}

}  // namespace palpa::gui
