#include "app/gui/actions/file_actions.h"

#include <QFileDialog>
#include <QMessageBox>

#include "app/core/new_project.h"
#include "app/gui/appearance.h"
#include "app/gui/editor.h"
#include "app/gui/main_window.h"
#include "app/gui/menus.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {

FileActions::FileActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  makeNewMenu();
  Menus& menus = workspace_.menus;
  QMenu* menu = menus.file;
  menus.bar->addAction(
      menus.add(menu, {"open", tr("&Open …"), QKeySequence::Open}, this, [this] {
        if (!mayDiscard()) return;
        const QString file = QFileDialog::getOpenFileName(
            &workspace_.window, tr("Open"), workspace_.settings.lastFolder(),
            tr("Projects (*.json);;CAD and meshes (*.step *.stp *.iges *.igs *.brep *.stl *.obj "
               "*.ply);;All files (*)"));
        if (!file.isEmpty()) openFile(file);
      }));
  menus.bar->addAction(
      menus.add(menu, {"save", tr("&Save"), QKeySequence::Save}, this, [this] { save(); }));
  menus.add(menu, {"save-as", tr("Save &as …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S)},
            this, [this] { saveAs(); });
  menu->addSeparator();
  menus.add(menu, {nullptr, tr("&Quit"), QKeySequence::Quit}, &workspace_.window, &QWidget::close);
  menus.bar->addSeparator();
}

void FileActions::makeNewMenu() {
  QMenu* fresh = workspace_.menus.file->addMenu(icon("new"), tr("&New"));
  const std::vector<std::pair<QString, modeling::Primitive>> shapes{
      {tr("Box"), {modeling::BoxShape{}}},
      {tr("Sphere"), {modeling::SphereShape{}}},
      {tr("Ellipsoid"), {modeling::EllipsoidShape{}}},
      {tr("Cylinder"), {modeling::CylinderShape{}}},
      {tr("Cone"), {modeling::ConeShape{}}},
      {tr("Capsule"), {modeling::CapsuleShape{}}},
      {tr("Torus"), {modeling::TorusShape{}}}};
  for (const auto& [name, primitive] : shapes)
    fresh->addAction(name, this, [this, name = name, primitive = primitive] {
      if (!mayDiscard()) return;
      modeling::Project project =
          app::makeProject(modeling::makePrimitive(primitive), name.toStdString());
      project.primitive = primitive;
      project.material = workspace_.editor.project().material;
      workspace_.editor.start(std::move(project));
    });
}

bool FileActions::openFile(const QString& file) {
  return file.endsWith(".json", Qt::CaseInsensitive) ? workspace_.editor.open(file)
                                                     : workspace_.editor.importFile(file);
}

bool FileActions::save() {
  return workspace_.editor.fileName().isEmpty() ? saveAs() : workspace_.editor.save();
}

bool FileActions::saveAs() {
  QString file =
      QFileDialog::getSaveFileName(&workspace_.window, tr("Save as"),
                                   workspace_.editor.fileName(), tr("Projects (*.json)"));
  if (file.isEmpty()) return false;
  if (!file.endsWith(".json", Qt::CaseInsensitive)) file += ".json";
  return workspace_.editor.saveAs(file);
}

bool FileActions::mayDiscard() {
  if (!workspace_.editor.session().isModified()) return true;
  const auto answer = QMessageBox::question(
      &workspace_.window, tr("Unsaved changes"),
      tr("Save the changes to \"%1\"?")
          .arg(QString::fromStdString(workspace_.editor.project().name)),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save) return save();
  return answer == QMessageBox::Discard;
}

}  // namespace palpa::gui
