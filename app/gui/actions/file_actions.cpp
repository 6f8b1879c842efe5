#include "app/gui/actions/file_actions.h"

#include <QFileInfo>
#include <QMessageBox>

#include "app/core/session/new_project.h"
#include "app/gui/actions/export_report.h"
#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/export_dialog.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/picture_dialog.h"
#include "app/gui/dialogs/recovery_dialog.h"
#include "app/gui/dialogs/welcome_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/examples.h"
#include "app/gui/document/thumbnails.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/field_input.h"
#include "app/gui/workspace/menus.h"
#include "modeling/exchange/file_format.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
FileActions::FileActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  Menus& menus = workspace_.menus;
  QMenu* menu = menus.file;
  menus.bar->addAction(
      menus.add(menu, {"new", tr("&New …"), QKeySequence::New, tr("Create a solid from a shape")},
                this, [this] { newSolid(); }));
  menus.bar->addAction(menus.add(
      menu, {"open", tr("&Open …"), QKeySequence::Open, tr("Open a project, CAD file or mesh")},
      this, [this] { open(); }));
  QMenu* recent = menu->addMenu(tr("Open &recent"));
  recent->setObjectName("recent");
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fillRecentFiles(recent); });
  QMenu* examples = menu->addMenu(tr("E&xamples"));
  examples->setObjectName("examples");
  fillExamples(examples);
  menu->addSeparator();
  menus.bar->addAction(
      menus.add(menu, {"save", tr("&Save"), QKeySequence::Save}, this, [this] { save(); }));
  menus.add(menu, {"save-as", tr("Save &as …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S)},
            this, [this] { saveAs(); });
  menus.add(menu,
            {nullptr, tr("Reco&ver …"), {}, tr("Projects that were not saved before a crash")},
            this, [this] { recover(); });
  menu->addSeparator();
  addImportAndExport();
  menu->addSeparator();
  menus.add(menu, {nullptr, tr("&Quit"), QKeySequence::Quit}, &workspace_.window, &QWidget::close);
  menus.bar->addSeparator();
  Editor& editor = workspace_.editor;
  connect(&editor, &Editor::aboutToReplace, this, &FileActions::storeThumbnail);
  connect(&editor, &Editor::projectReplaced, this, [this, &editor] { file_ = editor.fileName(); });
  connect(&editor, &Editor::saved, this, [this](const QString& file) {
    file_ = QFileInfo(file).absoluteFilePath();
    workspace_.settings.addRecentFile(file);
    storeThumbnail();
  });
}

void FileActions::addImportAndExport() {
  Menus& menus = workspace_.menus;
  menus.add(menus.file,
            {"import", tr("&Import …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_I),
             tr("Create a project from a CAD file or a mesh")},
            this, [this] { importBody(false); });
  menus.add(menus.file,
            {nullptr,
             tr("Import with o&ptions …"),
             {},
             tr("Choose a solid, the unit, the scale and the upward direction of a file")},
            this, [this] { importBody(true); });
  menus.add(menus.file,
            {"export", tr("&Export …"), QKeySequence(Qt::CTRL | Qt::Key_E),
             tr("Write the body to a CAD file, a mesh, or a page to touch in a browser")},
            this, [this] { exportBody(); });
  menus.add(menus.file,
            {nullptr,
             tr("Export repor&t …"),
             {},
             tr("Write a report of the touches with pictures and tables, as a web page or PDF")},
            this, [this] {
              finishInput(workspace_.window);
              exportReport(workspace_);
            });
  menus.add(menus.file, {nullptr, tr("Save &picture …"), {}, tr("Write the view to a PNG file")},
            this, [this] { savePicture(); });
}

void FileActions::fillRecentFiles(QMenu* menu) {
  menu->clear();
  const QStringList files = workspace_.settings.recentFiles();
  for (const QString& file : files) {
    QAction* action = menu->addAction(QFileInfo(file).fileName().replace("&", "&&") + "\t" +
                                          QFileInfo(file).absolutePath().replace("&", "&&"),
                                      this, [this, file] {
                                        if (mayDiscard()) openFile(file);
                                      });
    action->setObjectName(file);
    action->setToolTip(file);
    if (!QFileInfo::exists(file)) {
      action->setEnabled(false);
      action->setToolTip(tr("%1 is not there any more").arg(file));
    }
  }
  if (files.isEmpty()) menu->addAction(tr("No files yet"))->setEnabled(false);
  menu->addSeparator();
  QAction* clear = menu->addAction(tr("&Clear list"), this, [this] {
    workspace_.settings.clearRecentFiles();
    keepThumbnails({});
  });
  clear->setObjectName("Clear list");
  clear->setEnabled(!files.isEmpty());
  menu->setToolTipsVisible(true);
}

void FileActions::fillExamples(QMenu* menu) {
  const auto add = [this](QMenu* to, const std::vector<Example>& list) {
    for (const Example& example : list) {
      QAction* action = to->addAction(example.title, this, [this, name = example.name] {
        if (mayDiscard()) openExample(name);
      });
      action->setObjectName(example.title);
      action->setStatusTip(example.description);
      action->setToolTip(example.description);
    }
    to->setToolTipsVisible(true);
  };
  add(menu, examples());
  menu->addSeparator();
  QMenu* design = menu->addMenu(tr("With &targets"));
  design->setObjectName("design examples");
  add(design, designExamples());
}

void FileActions::showWelcome() {
  WelcomeDialog dialog(workspace_.settings, &workspace_.window);
  dialog.exec();
  using Choice = WelcomeDialog::Choice;
  if (dialog.choice() == Choice::kNewSolid) newSolid();
  if (dialog.choice() == Choice::kOpen) open();
  if (dialog.choice() == Choice::kExample && mayDiscard()) openExample(dialog.chosen());
  if (dialog.choice() == Choice::kRecent && mayDiscard()) openFile(dialog.chosen());
}

void FileActions::storeThumbnail() {
  const app::Session& session = workspace_.editor.session();
  // The picture must show what the file contains; an imported file is never written.
  const bool isAsInFile =
      !session.isModified() && (session.file() || !session.document().canUndo());
  const bool isDrawn = workspace_.view.lastFrameMilliseconds() > 0;
  if (file_.isEmpty() || !isAsInFile || !isDrawn) return;
  const QString picture = thumbnailPath(file_);
  if (picture.isEmpty()) return;
  try {
    workspace_.view.writePicture(picture.toStdString(), kThumbnailSize);
    keepThumbnails(workspace_.settings.recentFiles());
  } catch (const std::exception&) {
    // The welcome dialog shows a sign instead.
  }
}

bool FileActions::save() {
  finishInput(workspace_.window);
  return workspace_.editor.fileName().isEmpty() ? saveAs() : workspace_.editor.save();
}

bool FileActions::saveAs() {
  finishInput(workspace_.window);
  const QString ending = infoOf(modeling::FileFormat::kProject).endings.front();
  const QString file =
      askFileToWrite(workspace_, tr("Save as"), tr("Projects (*%1)").arg(ending), ending);
  return !file.isEmpty() && workspace_.editor.saveAs(file);
}

void FileActions::recover() {
  Editor& editor = workspace_.editor;
  offerRecovery(
      editor, workspace_.window, [this] { return mayDiscard(); },
      [&editor](bool any) {
        if (!any) Q_EMIT editor.said(tr("There is nothing to recover"));
      });
}

void FileActions::exportBody() {
  finishInput(workspace_.window);
  ExportDialog dialog(workspace_.editor.project(), &workspace_.window);
  if (dialog.exec() != QDialog::Accepted) return;
  const QString file = askFileToWrite(workspace_, tr("Export"), dialog.filter(), dialog.ending());
  if (!file.isEmpty()) workspace_.editor.exportFile(file, dialog.surface(), dialog.page());
}

void FileActions::savePicture() {
  PictureDialog dialog(workspace_.view.size(), &workspace_.window);
  if (dialog.exec() != QDialog::Accepted) return;
  const QString file =
      askFileToWrite(workspace_, tr("Save picture"), tr("Pictures (*.png)"), ".png");
  if (file.isEmpty()) return;
  try {
    workspace_.view.writePicture(file.toStdString(), dialog.pictureSize());
    Q_EMIT workspace_.editor.said(tr("Picture saved to %1").arg(file));
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

void FileActions::newSolid() {
  if (!mayDiscard()) return;
  NewSolidDialog dialog(workspace_.settings, std::nullopt, &workspace_.window);
  if (dialog.exec() != QDialog::Accepted) return;
  try {
    const modeling::Primitive primitive = dialog.primitive();
    modeling::Project project =
        app::makeProject(modeling::makePrimitive(primitive), dialog.shapeTitle().toStdString());
    project.primitive = primitive;
    project.material = workspace_.editor.project().material;
    workspace_.editor.start(std::move(project));
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

bool FileActions::mayDiscard() {
  finishInput(workspace_.window);
  if (!workspace_.editor.session().isModified()) return true;
  const QString file = workspace_.editor.fileName();
  QMessageBox question(
      QMessageBox::Question, tr("Unsaved changes"),
      tr("Save the changes to “%1”?")
          .arg(file.isEmpty() ? QString::fromStdString(workspace_.editor.project().name)
                              : QFileInfo(file).fileName()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &workspace_.window);
  question.setInformativeText(file.isEmpty()
                                  ? tr("The project was never saved; without saving it is lost.")
                                  : tr("Without saving, the edits since the last save are lost."));
  question.setDefaultButton(QMessageBox::Save);
  const int answer = question.exec();
  if (answer == QMessageBox::Save) return save();
  return answer == QMessageBox::Discard;
}

}  // namespace palpa::gui
