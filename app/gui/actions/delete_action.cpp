#include "app/gui/actions/delete_action.h"

#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {

void addDeleteAction(const Workspace& workspace) {
  Editor& editor = workspace.editor;
  QAction* action =
      workspace.menus.add(workspace.menus.edit,
                          {"delete", QObject::tr("&Delete"), QKeySequence::Delete,
                           QObject::tr("Delete the selected support, load, touch or measurement")},
                          &editor, [&editor] { deleteSelected(editor); });
  // Small keyboards have no Delete key.
  action->setShortcuts({QKeySequence::Delete, Qt::Key_Backspace});
  const auto update = [action, &editor] { action->setEnabled(!editor.selection().empty()); };
  QObject::connect(&editor, &Editor::selectionChanged, action, update);
  update();
}

}  // namespace palpa::gui
