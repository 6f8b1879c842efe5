#include "app/gui/actions/delete_action.h"

#include "app/gui/document/naming.h"
#include "app/gui/document/editor.h"
#include "app/gui/window/main_window.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {

void addDeleteAction(const Workspace& workspace) {
  Editor& editor = workspace.editor;
  QAction* action =
      workspace.menus.add(workspace.menus.edit,
                          {"delete", MainWindow::tr("&Delete"), QKeySequence::Delete,
                           MainWindow::tr("Delete the selected support, load or touch")},
                          &editor, [&editor] { deleteSelected(editor); });
  // Small keyboards have no Delete.
  action->setShortcuts({QKeySequence::Delete, Qt::Key_Backspace});
  const auto update = [action, &editor] { action->setEnabled(!editor.selection().empty()); };
  QObject::connect(&editor, &Editor::selectionChanged, action, update);
  update();
}

}  // namespace palpa::gui
