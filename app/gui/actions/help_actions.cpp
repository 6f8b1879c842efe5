#include "app/gui/actions/help_actions.h"

#include <vtkVersion.h>
#include <Eigen/Core>
#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QMessageBox>

#include "app/gui/dialogs/guide_window.h"
#include "app/gui/dialogs/keys_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

/// The folder of the guide of the installation, or of the source folder the program was built in;
/// empty if absent.
QString findGuide() {
  const QString program = QCoreApplication::applicationDirPath();
  QStringList places{program + "/../share/doc/palpa/docs/guide"};
  for (QDir folder(program); folder.cdUp();) places << folder.filePath("docs/guide");
  for (const QString& place : places)
    if (QFileInfo::exists(place + "/README.md")) return QFileInfo(place).canonicalFilePath();
  return {};
}

/// Shows the guide where it describes the active tool.
void showGuide(const Workspace& workspace) {
  auto* guide = workspace.window.findChild<GuideWindow*>();
  if (!guide) {
    const QString folder = findGuide();
    if (folder.isEmpty()) {
      Q_EMIT workspace.editor.refused(
          QObject::tr("The user guide is not beside the program; install Palpa again"));
      return;
    }
    guide = new GuideWindow(folder, workspace.settings, &workspace.window);
  }
  guide->show();
  guide->raise();
  guide->activateWindow();
  guide->showTopic(workspace.tools.activeTopic());
}

QString aboutText() {
  return QObject::tr(
             "<h3>Palpa %1</h3><p>Model a solid and touch it: boundary elements give "
             "displacements and forces, with an estimate of their error.</p><p>Licence: "
             "GPL-3.0-or-later</p>"
             "<p>Qt %2, VTK %3, OpenCASCADE %4, Eigen %5</p>")
      .arg(QApplication::applicationVersion(), qVersion(), vtkVersion::GetVTKVersion(),
           PALPA_OPENCASCADE_VERSION,
           QString("%1.%2.%3")
               .arg(EIGEN_WORLD_VERSION)
               .arg(EIGEN_MAJOR_VERSION)
               .arg(EIGEN_MINOR_VERSION));
}

}  // namespace

void addHelpActions(const Workspace& workspace, FileActions& files) {
  Menus& menus = workspace.menus;
  QWidget* window = &workspace.window;
  menus.add(menus.help, {"help", QObject::tr("&User guide"), QKeySequence(Qt::Key_F1)}, window,
            [workspace] { showGuide(workspace); });
  menus.add(menus.help, {nullptr, QObject::tr("&Welcome …")}, &files, &FileActions::showWelcome);
  menus.add(menus.help,
            {nullptr, QObject::tr("&Keyboard and mouse …"), QKeySequence(Qt::CTRL | Qt::Key_F1)},
            window, [workspace] { KeysDialog(workspace).exec(); });
  menus.help->addSeparator();
  menus.add(menus.help, {nullptr, QObject::tr("&About Palpa")}, window,
            [window] { QMessageBox::about(window, QObject::tr("About Palpa"), aboutText()); });
}

}  // namespace palpa::gui
