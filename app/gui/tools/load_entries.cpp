#include "app/gui/tools/load_entries.h"

#include "app/gui/base/appearance.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

void beginLoad(const Workspace& workspace, LoadTool& tool, LoadKind kind) {
  Editor& editor = workspace.editor;
  if (kind == LoadKind::kGravity) {
    addGravity(editor, usualLoad(kind, editor.project()));
  } else if (actsOnPatches(kind) && !editor.selection().patches.empty()) {
    addLoadOnSelection(editor, kind);
  } else {
    editor.select({});
    workspace.tools.activate(&tool);
    tool.setKind(kind);
  }
}

}  // namespace

void addLoadEntries(const Workspace& workspace, LoadTool& tool) {
  Menus& menus = workspace.menus;
  QMenu* menu = menus.conditions->addMenu(icon("load-force"), LoadTool::tr("&New load"));
  menu->setToolTipsVisible(true);
  for (const LoadKind kind : {LoadKind::kPressure, LoadKind::kTraction, LoadKind::kTotalForce,
                              LoadKind::kMoment, LoadKind::kBump, LoadKind::kGravity}) {
    const LoadKindInfo& info = infoOf(kind);
    menus.add(menu, {info.icon, info.entry, {}, info.tip}, &tool,
              [workspace, &tool, kind] { beginLoad(workspace, tool, kind); });
  }
  const auto follow = [menu, &tools = workspace.tools] {
    menu->menuAction()->setVisible(tools.mode() == Mode::kModel);
  };
  QObject::connect(&workspace.tools, &ToolBox::changed, menu, follow);
}

}  // namespace palpa::gui
