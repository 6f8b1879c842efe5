#include "app/gui/actions/help_actions.h"

#include <QApplication>
#include <QMessageBox>

#include "app/gui/main_window.h"
#include "app/gui/menus.h"

namespace palpa::gui {

void addHelpActions(const Workspace& workspace) {
  MainWindow* window = &workspace.window;
  workspace.menus.add(
      workspace.menus.help, {nullptr, QObject::tr("&About Palpa")}, window, [window] {
        QMessageBox::about(
            window, QObject::tr("About Palpa"),
            QObject::tr("<b>Palpa</b> %1<p>Model a solid and touch it: boundary elements give "
                        "the exact displacement and force.<p>GPL-3.0-or-later")
                .arg(QApplication::applicationVersion()));
      });
}

}  // namespace palpa::gui
