#include "app/gui/simulate/simulate_actions.h"

#include <QActionGroup>
#include <QToolButton>

#include "app/gui/window/main_window.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/simulate/deformed_export.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {

using Kind = bem::ContactTool::Kind;
using app::SurfaceQuantity;

SimulateActions::SimulateActions(const Workspace& workspace, Simulation& simulation,
                                 SimulationView& pictures)
    : QObject(&workspace.window),
      workspace_(workspace),
      simulation_(simulation),
      pictures_(pictures),
      touches_(workspace.editor, simulation, this) {
  addModes();
  addTools();
  addPictures();
  recording_ = new RecordingActions(workspace, simulation);
  onlySimulating_.push_back(workspace.menus.add(
      workspace.menus.simulate,
      {nullptr,
       tr("Export &deformed solid …"),
       {},
       tr("Write the solid as it is touched now as patches, for CAD or to go on "
          "modelling")},
      this, [this] { exportDeformed(workspace_, simulation_); }));
  connect(&simulation, &Simulation::activeChanged, this, &SimulateActions::show);
  connect(&options_, &SimulateOptions::changed, this, [this] {
    if (simulation_.drawn()) simulation_.setFingertip(options_.radius(*simulation_.drawn()));
  });
  for (auto signal : {&Simulation::bodyChanged, &Simulation::leaving})
    connect(&simulation, signal, this, &SimulateActions::updatePlay);
  connect(&workspace.editor, &Editor::projectChanged, this, &SimulateActions::updatePlay);
  connect(&workspace.editor, &Editor::projectReplaced, this, &SimulateActions::updatePlay);
  show(false);
}

void SimulateActions::updatePlay() {
  play_->setVisible(simulation_.isActive());
  play_->setEnabled(simulation_.isActive() && simulation_.drawn() &&
                    !workspace_.editor.project().touches.empty());
}

void SimulateActions::addModes() {
  Menus& menus = workspace_.menus;
  auto* modes = new QActionGroup(this);
  model_ = menus.add(menus.simulate,
                     {"model", tr("M&odel"), QKeySequence(Qt::SHIFT | Qt::Key_F5),
                      tr("Shape the solid: control points, supports, loads")},
                     this, [this] { simulation_.setActive(false); });
  simulate_ = menus.add(menus.simulate,
                        {"simulate", tr("&Simulate"), QKeySequence(Qt::Key_F5),
                         tr("Touch the solid and read the forces")},
                        this, [this] { simulation_.setActive(true); });
  for (QAction* action : {model_, simulate_}) {
    action->setCheckable(true);
    modes->addAction(action);
    menus.bar->insertAction(menus.views, action);
    // Where one is matters more than anything else in the bar: with words.
    static_cast<QToolButton*>(menus.bar->widgetForAction(action))
        ->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  menus.simulate->addSeparator();
}

void SimulateActions::addTools() {
  const auto add = [this](Kind kind, const Menus::Item& item) {
    workspace_.tools.add(
        std::make_unique<SimulateTool>(kind, workspace_.settings, simulation_, options_, workspace_.view),
        workspace_.menus.simulate, item, Mode::kSimulate);
  };
  add(Kind::kGrab, {"hand-grab", tr("&Grab"), QKeySequence(Qt::Key_H),
                    tr("Take hold of the surface and pull it anywhere")});
  add(Kind::kPush, {"hand-push", tr("&Push"), QKeySequence(Qt::Key_P),
                    tr("Press with a fingertip that slides and sticks")});
  add(Kind::kProbe, {"hand-ball", tr("&Ball"), QKeySequence(Qt::Key_B),
                     tr("Press with a rigid ball; the contact grows with depth")});
  add(Kind::kForce,
      {"hand-force", tr("&Force"), QKeySequence(Qt::Key_D), tr("Pull with a given force")});
  workspace_.menus.simulate->addSeparator();
  play_ = workspace_.menus.add(
      workspace_.menus.simulate,
      {"place-touch", tr("Play the &touches of the project"), QKeySequence(Qt::Key_T),
       tr("Touch the solid as the project says; the touches stay as pins")},
      this, [this] { touches_.play(); });
  onlySimulating_.push_back(workspace_.menus.add(
      workspace_.menus.simulate,
      {"hand-release", tr("&Let go of all"), {}, tr("Remove all contacts and pins (Escape)")}, this,
      [this] { simulation_.letGoOfAll(); }));
  workspace_.menus.simulate->addSeparator();
}

void SimulateActions::addPictures() {
  Menus& menus = workspace_.menus;
  QMenu* colours = menus.simulate->addMenu(tr("&Colour by"));
  auto* group = new QActionGroup(this);
  const auto add = [&](SurfaceQuantity quantity, const QString& text) {
    QAction* action = menus.addToggle(colours, {nullptr, text}, simulation_.quantity() == quantity,
                                      this, [this, quantity](bool on) {
                                        if (on) simulation_.setQuantity(quantity);
                                      });
    group->addAction(action);
  };
  add(SurfaceQuantity::kDisplacement, tr("&Displacement |u|"));
  add(SurfaceQuantity::kNormalTraction, tr("&Normal traction"));
  add(SurfaceQuantity::kVonMises, tr("&von Mises stress"));
  add(SurfaceQuantity::kStiffness, tr("&Stiffness under a fingertip"));
  add(SurfaceQuantity::kNone, tr("&Plain"));
  menus.addToggle(menus.simulate,
                  {nullptr, tr("&Undeformed shape"), {}, tr("Show where the surface was")},
                  pictures_.isGhostShown(), this, [this](bool on) { pictures_.setGhostShown(on); });
  QMenu* scales = menus.simulate->addMenu(tr("D&raw displacements"));
  auto* factors = new QActionGroup(this);
  for (const int factor : {0, 1, 2, 5, 10, 50}) {
    QAction* action =
        menus.addToggle(scales, {nullptr, factor == 0 ? tr("Not at all") : tr("× %1").arg(factor)},
                        simulation_.scale() == factor, this, [this, factor](bool on) {
                          if (on) simulation_.setScale(factor);
                        });
    factors->addAction(action);
  }
}

void SimulateActions::show(bool isActive) {
  (isActive ? simulate_ : model_)->setChecked(true);
  for (QAction* action : onlySimulating_) action->setEnabled(isActive);
  updatePlay();
  // The net is not drawn while the solid is touched.
  if (auto* net = workspace_.window.findChild<QAction*>("Control net")) net->setEnabled(!isActive);
  workspace_.tools.setMode(isActive ? Mode::kSimulate : Mode::kModel);
}

}  // namespace palpa::gui
