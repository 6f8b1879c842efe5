#include "app/gui/tools/surface_tools.h"

#include "app/gui/tools/knot_tool.h"
#include "app/gui/tools/load_tool.h"
#include "app/gui/tools/remove_knot_tool.h"
#include "app/gui/tools/support_tool.h"
#include "app/gui/tools/touch_tool.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

template <class SurfaceTool>
void add(const Workspace& workspace, QMenu* menu, const Menus::Item& item) {
  workspace.tools.add(std::make_unique<SurfaceTool>(workspace.settings, workspace.editor,
                                                    workspace.scene, workspace.view),
                      menu, item);
}

}  // namespace

void addSurfaceTools(const Workspace& workspace) {
  const auto tr = [](const char* text) { return SupportTool::tr(text); };
  Menus& menus = workspace.menus;
  add<SupportTool>(workspace, menus.conditions,
                   {"paint-support", tr("&Paint support"), QKeySequence(Qt::Key_P),
                    tr("Choose where the body is supported: patch by patch, or with a brush")});
  add<LoadTool>(workspace, menus.conditions,
                {"place-load", tr("Place &load"), QKeySequence(Qt::Key_L),
                 tr("Press or pull at patches, or around a point")});
  add<TouchTool>(workspace, menus.conditions,
                 {"place-touch", tr("Place &touch"), QKeySequence(Qt::Key_T),
                  tr("Record a touch: press on the surface and pull")});
  add<KnotTool>(workspace, menus.solid,
                {"insert-knot", tr("Insert &knot"), QKeySequence(Qt::Key_K),
                 tr("Insert a line of control points; the shape stays")});
  add<RemoveKnotTool>(workspace, menus.solid,
                      {"remove-knot", tr("&Remove knot"), QKeySequence(Qt::SHIFT | Qt::Key_K),
                       tr("Remove a line of control points where the shape allows it")});
}

}  // namespace palpa::gui
