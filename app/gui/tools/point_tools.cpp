#include "app/gui/tools/point_tools.h"

#include "app/gui/tools/rotate_tool.h"
#include "app/gui/tools/scale_tool.h"
#include "app/gui/tools/select_tool.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {

void addPointTools(const Workspace& workspace, PointOptions& options) {
  const auto tr = [](const char* text) { return SelectTool::tr(text); };
  ToolBox& tools = workspace.tools;
  QMenu* edit = workspace.menus.edit;
  tools.add(std::make_unique<SelectTool>(workspace, options), workspace.menus.select,
            {"select", tr("&Select and move"), QKeySequence(Qt::Key_S),
             tr("Select control points, patches or edges and drag them")});
  tools.add(std::make_unique<RotateTool>(workspace, options), edit,
            {"rotate", tr("R&otate"), QKeySequence(Qt::Key_R),
             tr("Turn the selected points about an axis")});
  tools.add(std::make_unique<ScaleTool>(workspace, options), edit,
            {"scale", tr("S&cale"), QKeySequence(Qt::Key_C),
             tr("Scale the selected points from their middle")});
}

}  // namespace palpa::gui
