#include "app/gui/actions/primitive_actions.h"

#include "app/gui/base/translate.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/profile_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/workspace/menus.h"
#include "modeling/shapes/shape_sketch.h"

namespace palpa::gui {
namespace {

void editPrimitive(const Workspace& workspace) {
  NewSolidDialog dialog(workspace.settings, workspace.editor.project().primitive,
                        &workspace.window);
  if (dialog.exec() == QDialog::Accepted)
    workspace.editor.perform(modeling::MakePrimitive{dialog.primitive()});
}

}  // namespace

void addPrimitiveActions(const Workspace& workspace) {
  Menus& menus = workspace.menus;
  QAction* sizes = menus.add(menus.solid,
                             {nullptr,
                              tr("Edit &primitive …"),
                              {},
                              tr("Change the sizes of the shape of the solid; possible until "
                                 "control points are edited")},
                             &workspace.window, [workspace] { editPrimitive(workspace); });
  QAction* profile = menus.add(menus.solid,
                               {nullptr,
                                tr("Edit pro&file …"),
                                {},
                                tr("Draw and edit the curves of a revolved, extruded or lofted "
                                   "solid; possible until control points are edited")},
                               &workspace.window, [workspace] { editProfileOfProject(workspace); });
  const Editor& editor = workspace.editor;
  const auto update = [&editor, sizes, profile] {
    const auto& primitive = editor.project().primitive;
    sizes->setEnabled(primitive.has_value());
    profile->setEnabled(primitive && modeling::hasProfile(*primitive));
  };
  QObject::connect(&editor, &Editor::projectReplaced, &workspace.window, update);
  QObject::connect(&editor, &Editor::projectChanged, &workspace.window, update);
  update();
}

}  // namespace palpa::gui
