#include "app/gui/actions/view_actions.h"

#include "app/gui/main_window.h"
#include "app/gui/menus.h"
#include "app/gui/viewport_widget.h"

namespace palpa::gui {

using view::StandardView;

ViewActions::ViewActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  Menus& menus = workspace_.menus;
  const auto look = [&](const char* picture, const QString& text, QKeySequence keys,
                        StandardView from) {
    return menus.add(menus.view, {picture, text, keys}, this, [this, from] {
      workspace_.view.viewport().lookFrom(from);
      workspace_.view.viewport().fit();
      workspace_.view.update();
    });
  };
  menus.bar->addAction(
      menus.add(menus.view, {"fit", tr("&Fit"), QKeySequence(Qt::Key_F)}, this, [this] {
        workspace_.view.viewport().fit();
        workspace_.view.update();
      }));
  menus.bar->addAction(look("view-isometric", tr("&Isometric"), QKeySequence(Qt::Key_0),
                            StandardView::kIsometric));
  menus.bar->addAction(
      look("view-front", tr("F&ront"), QKeySequence(Qt::Key_1), StandardView::kFront));
  menus.bar->addAction(
      look("view-right", tr("R&ight"), QKeySequence(Qt::Key_3), StandardView::kRight));
  menus.bar->addAction(look("view-top", tr("&Top"), QKeySequence(Qt::Key_7), StandardView::kTop));
  menus.view->addSeparator();
  const auto toggle = [&](const Menus::Item& item, bool isOn, void (view::Viewport::*set)(bool)) {
    menus.bar->addAction(menus.addToggle(menus.view, item, isOn, this, [this, set](bool on) {
      (workspace_.view.viewport().*set)(on);
      workspace_.view.update();
    }));
  };
  toggle({"perspective", tr("&Parallel projection"), QKeySequence(Qt::Key_5)}, false,
         &view::Viewport::setParallelProjection);
  toggle({"net", tr("&Control net"), QKeySequence(Qt::Key_N)}, true,
         &view::Viewport::setControlNetVisible);
  toggle({"grid", tr("&Grid"), QKeySequence(Qt::Key_G)}, true, &view::Viewport::setGridVisible);
  menus.view->addSeparator();
}

}  // namespace palpa::gui
