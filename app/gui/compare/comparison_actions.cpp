#include "app/gui/compare/comparison_actions.h"

#include <QFileInfo>
#include <exception>

#include "app/gui/base/background_job.h"
#include "app/gui/compare/state_choice_dialog.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/widgets/field_input.h"
#include "app/gui/workspace/menus.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/project_file.h"

namespace palpa::gui {

ComparisonActions::ComparisonActions(const Workspace& workspace, VariantComparison& comparison)
    : QObject(&workspace.window), workspace_(workspace), comparison_(comparison) {
  Menus& menus = workspace_.menus;
  QAction* withFile = menus.add(menus.file,
                                {"compare",
                                 tr("Co&mpare with …"),
                                 {},
                                 tr("Compare with another project under the same touches")},
                                this, [this] { chooseFile(); });
  withState_ = menus.add(menus.file,
                         {nullptr,
                          tr("Compare with the state &before …"),
                          {},
                          tr("Compare with an earlier state of this project")},
                         this, [this] { chooseState(); });
  // Above Quit.
  const QList<QAction*> entries = menus.file->actions();
  for (QAction* entry : entries)
    if (entry->objectName() == "Quit") {
      menus.file->insertActions(entry, {withFile, withState_});
      menus.file->insertSeparator(entry);
    }
  connect(&workspace.editor, &Editor::fileChanged, this, &ComparisonActions::update);
  update();
}

void ComparisonActions::update() {
  const Editor& editor = workspace_.editor;
  withState_->setEnabled(editor.session().document().canUndo() || !editor.fileName().isEmpty());
}

void ComparisonActions::chooseFile() {
  const std::string patterns = modeling::endingPatterns([](const modeling::FileFormatInfo& info) {
    return info.kind == modeling::FileKind::kProject;
  });
  const QString file =
      askFileToOpen(workspace_, tr("Compare with"),
                    tr("Projects (%1);;All files (*)").arg(QString::fromStdString(patterns)));
  if (!file.isEmpty()) compareWithFile(file);
}

bool ComparisonActions::compareWithFile(const QString& file) {
  if (isBackgroundJobRunning()) return false;
  const QString path = QFileInfo(file).absoluteFilePath();
  try {
    const auto project =
        runInBackground(workspace_.window, tr("Reading %1").arg(QFileInfo(file).fileName()),
                        [&path](const Job&) { return modeling::readProject(path.toStdString()); });
    if (!project) return false;
    const bool isOwn = path == QFileInfo(workspace_.editor.fileName()).absoluteFilePath();
    const QString name = QFileInfo(file).fileName();
    comparison_.start(*project, isOwn ? tr("%1 as saved").arg(name) : name, path);
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
    return false;
  }
  Q_EMIT begun();
  return true;
}

void ComparisonActions::chooseState() {
  finishInput(workspace_.window);
  const Editor& editor = workspace_.editor;
  StateChoiceDialog dialog(editor.session().document().history(), editor.fileName(),
                           &workspace_.window);
  if (dialog.exec() != QDialog::Accepted) return;
  if (dialog.step() > 0)
    compareWithStateBefore(dialog.step());
  else if (!editor.fileName().isEmpty())
    compareWithFile(editor.fileName());
}

void ComparisonActions::compareWithStateBefore(std::size_t step) {
  const modeling::Document& document = workspace_.editor.session().document();
  const modeling::Document::History history = document.history();
  if (step < 1 || step >= history.labels.size()) return;
  comparison_.start(*document.state(step - 1),
                    tr("before “%1”").arg(QString::fromStdString(history.labels[step])));
  Q_EMIT begun();
}

void ComparisonActions::reload() {
  if (!comparison_.file().isEmpty()) compareWithFile(comparison_.file());
}

}  // namespace palpa::gui
