#include "app/gui/dialogs/file_dialogs.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

#include "app/gui/document/editor.h"

namespace palpa::gui {

QString askFileToOpen(const Workspace& workspace, const QString& title, const QString& filter) {
  const QString file = QFileDialog::getOpenFileName(&workspace.window, title,
                                                    workspace.settings.lastFolder(), filter);
  if (!file.isEmpty()) workspace.settings.setLastFolder(QFileInfo(file).absolutePath());
  return file;
}

QString askFileToWrite(const Workspace& workspace, const QString& title, const QString& filter,
                       const QString& ending) {
  QFileDialog dialog(&workspace.window, title, workspace.settings.lastFolder(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(ending);  // set before the dialog asks about overwriting
  const QString present = workspace.editor.fileName();
  QString name = present.isEmpty() ? QString::fromStdString(workspace.editor.project().name)
                                   : QFileInfo(present).completeBaseName();
  if (!present.isEmpty()) dialog.setDirectory(QFileInfo(present).absolutePath());
  dialog.selectFile(name.replace('/', '-') + ending);
  if (dialog.exec() != QDialog::Accepted) return {};
  QString file = dialog.selectedFiles().value(0);
  // The ending decides the format: another ending would write another format or none.
  if (!file.endsWith(ending, Qt::CaseInsensitive)) {
    file += ending;
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

}  // namespace palpa::gui
