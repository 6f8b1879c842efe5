#include "app/gui/simulate/simulate_actions.h"

#include <QActionGroup>
#include <QToolButton>
#include <array>

#include "app/gui/simulate/deformed_export.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {

using Kind = bem::ContactTool::Kind;

namespace {

Menus::Item itemOf(Kind kind) {
  const auto tr = [](const char* text) { return SimulateActions::tr(text); };
  switch (kind) {
    case Kind::kGrab:
      return {"simulate-grab", tr("&Grab"), QKeySequence(Qt::Key_H),
              tr("Grab the surface and pull it in any direction")};
    case Kind::kPush:
      return {"simulate-push", tr("&Push"), QKeySequence(Qt::Key_P),
              tr("Press with a fingertip that slides and sticks")};
    case Kind::kBall:
      return {"simulate-ball", tr("&Ball"), QKeySequence(Qt::Key_B),
              tr("Press with a rigid ball; the contact grows with depth")};
    case Kind::kForce:
      return {"simulate-force", tr("&Force"), QKeySequence(Qt::Key_D),
              tr("Pull with a given force")};
  }
  return {};
}

}  // namespace

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
  onlySimulating_.push_back(
      workspace.menus.add(workspace.menus.simulate,
                          {nullptr,
                           tr("Export &deformed solid …"),
                           {},
                           tr("Write the deformed solid as patches, for CAD or further modelling")},
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
    // The mode is the most important state in the bar: show its name.
    static_cast<QToolButton*>(menus.bar->widgetForAction(action))
        ->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  menus.simulate->addSeparator();
}

void SimulateActions::addTools() {
  static constexpr std::array kKinds{Kind::kGrab, Kind::kPush, Kind::kBall, Kind::kForce};
  static_assert(kKinds.size() + 1 == modeling::kTouchKinds.size(), "all kinds except pins");
  for (const Kind kind : kKinds)
    workspace_.tools.add(std::make_unique<SimulateTool>(kind, workspace_.settings, simulation_,
                                                        options_, workspace_.view),
                         workspace_.menus.simulate, itemOf(kind), Mode::kSimulate);
  workspace_.menus.simulate->addSeparator();
  play_ = workspace_.menus.add(
      workspace_.menus.simulate,
      {"place-touch", tr("Play the &touches of the project"), QKeySequence(Qt::Key_T),
       tr("Perform the stored touches; they stay as pins")},
      this, [this] { touches_.play(); });
  onlySimulating_.push_back(workspace_.menus.add(
      workspace_.menus.simulate,
      {"simulate-release", tr("&Release all"), {}, tr("Remove all contacts and pins (Escape)")},
      this, [this] { simulation_.endAll(); }));
  workspace_.menus.simulate->addSeparator();
}

void SimulateActions::addPictures() {
  Menus& menus = workspace_.menus;
  QMenu* colours = menus.simulate->addMenu(tr("&Colour by"));
  auto* group = new QActionGroup(this);
  for (const app::SurfaceQuantityInfo& info : app::kSurfaceQuantities) {
    const bool isPlain = info.quantity == app::SurfaceQuantity::kNone;
    QAction* action = menus.addToggle(
        colours, {nullptr, isPlain ? tr("&Plain") : "&" + tr(info.label)},
        simulation_.quantity() == info.quantity, this, [this, quantity = info.quantity](bool on) {
          if (on) simulation_.setQuantity(quantity);
        });
    group->addAction(action);
  }
  menus.addToggle(menus.simulate,
                  {nullptr, tr("&Undeformed shape"), {}, tr("Show the undeformed shape as lines")},
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
  workspace_.tools.setMode(isActive ? Mode::kSimulate : Mode::kModel);
}

}  // namespace palpa::gui
