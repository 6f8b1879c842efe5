#include "app/gui/tools/surface_tools.h"

#include "app/gui/tools/knot_tool.h"
#include "app/gui/tools/load_entries.h"
#include "app/gui/tools/load_tool.h"
#include "app/gui/tools/measure_tool.h"
#include "app/gui/tools/remove_knot_tool.h"
#include "app/gui/tools/support_tool.h"
#include "app/gui/tools/touch_tool.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

template <class SurfaceTool>
SurfaceTool& add(const Workspace& workspace, QMenu* menu, const Menus::Item& item) {
  auto tool = std::make_unique<SurfaceTool>(workspace.settings, workspace.editor, workspace.scene,
                                            workspace.view);
  SurfaceTool& added = *tool;
  workspace.tools.add(std::move(tool), menu, item);
  return added;
}

}  // namespace

void addSurfaceTools(const Workspace& workspace) {
  const auto tr = [](const char* text) { return SupportTool::tr(text); };
  Menus& menus = workspace.menus;
  add<SupportTool>(workspace, menus.conditions,
                   {"paint-support", tr("&Paint support"), QKeySequence(Qt::Key_P),
                    tr("Choose where the body is supported: patch by patch, or with a brush")});
  addLoadEntries(workspace,
                 add<LoadTool>(workspace, menus.conditions,
                               {"place-load", tr("Place &load"), QKeySequence(Qt::Key_L),
                                tr("Forces, moments and pressures on patches or around a point, "
                                   "and gravity")}));
  add<TouchTool>(workspace, menus.conditions,
                 {"place-touch", tr("Place &touch"), QKeySequence(Qt::Key_T),
                  tr("Record a touch: press on the surface and pull")});
  add<KnotTool>(workspace, menus.solid,
                {"insert-knot", tr("Insert &knot"), QKeySequence(Qt::Key_K),
                 tr("Insert a line of control points; the shape stays")});
  add<RemoveKnotTool>(workspace, menus.solid,
                      {"remove-knot", tr("&Remove knot"), QKeySequence(Qt::SHIFT | Qt::Key_K),
                       tr("Remove a line of control points where the shape allows it")});
  add<MeasureTool>(workspace, menus.solid,
                   {"measure", tr("&Measure"), QKeySequence(Qt::Key_M),
                    tr("Distances, lengths, angles, wall thicknesses and radii of the body")});
}

}  // namespace palpa::gui
