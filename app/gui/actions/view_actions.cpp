#include "app/gui/actions/view_actions.h"

#include <QActionGroup>
#include <cmath>

#include "app/gui/base/appearance.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

constexpr double kOrbitStep = 37.4;  // logical pixels: 15 degrees
constexpr double kZoomStep = 1.25;

}  // namespace

using view::Shading;
using view::StandardView;
using view::Viewport;

ViewActions::ViewActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  addFits();
  addDirections();
  addNavigation();
  addShadings();
  addToggles();
  connect(&workspace_.editor, &Editor::aboutToSave, this, &ViewActions::save);
  connect(&workspace_.editor, &Editor::projectReplaced, this, &ViewActions::restore);
  restore();
}

void ViewActions::addFits() {
  Menus& menus = workspace_.menus;
  menus.bar->addAction(menus.add(
      menus.view, {"fit", tr("&Fit all"), QKeySequence(Qt::Key_F), tr("Show all of the body")},
      this, [this] {
        workspace_.view.viewport().fit();
        workspace_.view.update();
      }));
  QAction* selection = menus.add(menus.view,
                                 {"fit-selection", tr("Fit &selection"),
                                  QKeySequence(Qt::SHIFT | Qt::Key_F), tr("Show the selection")},
                                 this, [this] { fitSelection(); });
  selection->setShortcuts({QKeySequence(Qt::SHIFT | Qt::Key_F), QKeySequence(Qt::Key_Period)});
  menus.view->addSeparator();
}

void ViewActions::addDirections() {
  Menus& menus = workspace_.menus;
  const auto add = [&](const char* picture, const QString& text, QKeySequence keys,
                       StandardView from) {
    return menus.add(menus.view, {picture, text, keys}, this, [this, from] { look(from); });
  };
  menus.bar->addAction(
      add("view-isometric", tr("&Isometric"), QKeySequence(Qt::Key_0), StandardView::kIsometric));
  menus.bar->addAction(
      add("view-front", tr("F&ront"), QKeySequence(Qt::Key_1), StandardView::kFront));
  add("view-back", tr("&Back"), QKeySequence(Qt::CTRL | Qt::Key_1), StandardView::kBack);
  menus.bar->addAction(
      add("view-right", tr("Ri&ght"), QKeySequence(Qt::Key_3), StandardView::kRight));
  add("view-left", tr("&Left"), QKeySequence(Qt::CTRL | Qt::Key_3), StandardView::kLeft);
  menus.bar->addAction(add("view-top", tr("&Top"), QKeySequence(Qt::Key_7), StandardView::kTop));
  add("view-bottom", tr("Botto&m"), QKeySequence(Qt::CTRL | Qt::Key_7), StandardView::kBottom);
  menus.add(menus.view,
            {"view-opposite", tr("&Opposite side"), QKeySequence(Qt::Key_9),
             tr("Look from the opposite side")},
            this, [this] { lookFromOpposite(); });
  menus.view->addSeparator();
}

void ViewActions::addNavigation() {
  Menus& menus = workspace_.menus;
  QMenu* orbitMenu = menus.view->addMenu(icon("rotate"), tr("Orbit and &zoom"));
  orbitMenu->setToolTipsVisible(true);
  // Plain arrow keys move the selection.
  const auto add = [&](const QString& text, int key, const Eigen::Vector2d& step) {
    menus.add(orbitMenu, {nullptr, text, QKeySequence(Qt::ALT | key)}, this,
              [this, step] { orbit(kOrbitStep * step); });
  };
  add(tr("Orbit &left"), Qt::Key_Left, {-1, 0});
  add(tr("Orbit &right"), Qt::Key_Right, {1, 0});
  add(tr("Orbit &up"), Qt::Key_Up, {0, -1});
  add(tr("Orbit &down"), Qt::Key_Down, {0, 1});
  QAction* in = menus.add(orbitMenu, {nullptr, tr("Zoom &in"), QKeySequence(Qt::Key_Plus)}, this,
                          [this] { zoom(kZoomStep); });
  in->setShortcuts({QKeySequence(Qt::Key_Plus), QKeySequence(Qt::Key_Equal)});
  menus.add(orbitMenu, {nullptr, tr("Zoom &out"), QKeySequence(Qt::Key_Minus)}, this,
            [this] { zoom(1 / kZoomStep); });
  parallel_ = menus.addToggle(menus.view,
                              {"perspective", tr("&Parallel projection"), QKeySequence(Qt::Key_5),
                               tr("Without perspective")},
                              false, this, [this](bool on) {
                                workspace_.view.viewport().setParallelProjection(on);
                                workspace_.view.update();
                              });
  menus.bar->addAction(parallel_);
  menus.view->addSeparator();
}

void ViewActions::addShadings() {
  Menus& menus = workspace_.menus;
  auto* group = new QActionGroup(this);
  const auto add = [&](const char* picture, const QString& text, Shading shading) {
    QAction* action =
        menus.addToggle(menus.view, {picture, text}, shading == Shading::kShadedWithEdges, this,
                        [this, shading](bool on) {
                          if (!on) return;
                          workspace_.view.viewport().setShading(shading);
                          workspace_.view.update();
                        });
    group->addAction(action);
    shadings_.push_back(action);
  };
  add("shaded", tr("S&haded"), Shading::kShaded);
  add("shaded-edges", tr("Shaded with &edges"), Shading::kShadedWithEdges);
  add("wire", tr("&Wire"), Shading::kWire);
  menus.add(menus.view,
            {nullptr, tr("Ne&xt shading"), QKeySequence(Qt::Key_Z),
             tr("Shaded, with edges, wire in turn")},
            this, [this] {
              std::size_t next = 0;
              for (std::size_t k = 0; k < shadings_.size(); ++k)
                if (shadings_[k]->isChecked()) next = (k + 1) % shadings_.size();
              shadings_[next]->setChecked(true);
            });
  menus.view->addSeparator();
}

void ViewActions::addToggles() {
  Menus& menus = workspace_.menus;
  const auto add = [&](const Menus::Item& item, bool SavedView::*shown,
                       void (Viewport::*set)(bool)) {
    QAction* action = menus.addToggle(menus.view, item, true, this, [this, set](bool on) {
      (workspace_.view.viewport().*set)(on);
      workspace_.view.update();
    });
    parts_.push_back({action, shown});
    return action;
  };
  QAction* net = add({"net", tr("&Control net"), QKeySequence(Qt::Key_N)}, &SavedView::showsNet,
                     &Viewport::setControlNetVisible);
  menus.bar->addAction(net);
  // Simulate mode draws no control net.
  connect(&workspace_.tools, &ToolBox::changed, net,
          [this, net] { net->setEnabled(workspace_.tools.mode() == Mode::kModel); });
  menus.bar->addAction(add({"grid", tr("Gri&d"), QKeySequence(Qt::Key_G)}, &SavedView::showsGrid,
                           &Viewport::setGridVisible));
  add({"axes", tr("&Axes")}, &SavedView::showsAxes, &Viewport::setAxesVisible);
  workspace_.view.viewport().setViewCubeVisible(true);
  add({"view-isometric", tr("View c&ube"), {}, tr("Cube whose sides turn the view to them")},
      &SavedView::showsCube, &Viewport::setViewCubeVisible);
  add({"paint-support", tr("Supports a&nd loads")}, &SavedView::showsConditions,
      &Viewport::setRegionsVisible);
  add({"place-touch", tr("Touch mar&ks")}, &SavedView::showsTouches, &Viewport::setTouchesVisible);
  add({"measure", tr("Dim&ensions")}, &SavedView::showsDimensions, &Viewport::setDimensionsVisible);
  add({"warning", tr("Warning signs (&!)")}, &SavedView::showsWarnings,
      &Viewport::setWarningsVisible);
  menus.view->addSeparator();
}

void ViewActions::look(StandardView from) {
  workspace_.view.viewport().lookFrom(from);
  workspace_.view.viewport().fit();
  workspace_.view.update();
}

void ViewActions::lookFromOpposite() {
  view::CameraView camera = workspace_.view.viewport().camera();
  camera.direction = -camera.direction;
  // From above or below, rotate about the horizontal line of the picture.
  if (std::abs(camera.direction.z()) > 1 - 1e-9) camera.up = -camera.up;
  workspace_.view.viewport().setCamera(camera);
  workspace_.view.update();
}

void ViewActions::orbit(const Eigen::Vector2d& pixels) {
  workspace_.view.viewport().orbit(pixels * workspace_.view.devicePixelRatioF());
  workspace_.view.updateQuickly();
}

void ViewActions::zoom(double factor) {
  const QSize size = workspace_.view.size();
  const Eigen::Vector2d middle = Eigen::Vector2d(size.width(), size.height()) / 2;
  workspace_.view.viewport().zoom(factor, middle * workspace_.view.devicePixelRatioF());
  workspace_.view.updateQuickly();
}

void ViewActions::fitSelection() {
  const std::vector<Eigen::Vector3d> places = workspace_.scene.selectedPlaces();
  if (places.empty())
    workspace_.view.viewport().fit();
  else
    workspace_.view.viewport().fitTo(places);
  workspace_.view.update();
}

void ViewActions::save() {
  SavedView saved;
  saved.camera = workspace_.view.viewport().camera();
  for (std::size_t k = 0; k < shadings_.size(); ++k)
    if (shadings_[k]->isChecked()) saved.shading = static_cast<Shading>(k);
  for (const Part& part : parts_) saved.*part.shown = part.action->isChecked();
  workspace_.editor.setView(viewText(saved, workspace_.editor.project().view));
}

void ViewActions::restore() {
  const SavedView saved = viewFromText(workspace_.editor.project().view).value_or(SavedView());
  shadings_[static_cast<std::size_t>(saved.shading)]->setChecked(true);
  for (const Part& part : parts_) part.action->setChecked(saved.*part.shown);
  parallel_->setChecked(saved.camera.parallel);
  workspace_.view.viewport().setCamera(saved.camera);
  workspace_.view.update();
}

}  // namespace palpa::gui
