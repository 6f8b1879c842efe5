#include "app/gui/simulate/simulate_actions.h"

#include <QActionGroup>
#include <QToolButton>
#include <algorithm>
#include <array>

#include "app/gui/dialogs/colour_range_dialog.h"
#include "app/gui/document/touch_gradient.h"
#include "app/gui/simulate/deformed_export.h"
#include "app/gui/simulate/device_actions.h"
#include "app/gui/simulate/exact_touch_tool.h"
#include "app/gui/simulate/mouse_3d_control.h"
#include "app/gui/simulate/sample_tool.h"
#include "app/gui/simulate/section_tool.h"
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
                                 SimulationView& pictures, SectionView& section, Samples& samples)
    : QObject(&workspace.window),
      workspace_(workspace),
      simulation_(simulation),
      pictures_(pictures),
      section_(section),
      samples_(samples),
      touches_(workspace.editor, simulation, this) {
  addModes();
  addTools();
  addPictures();
  addColourRange();
  addSection();
  addGradient();
  recording_ = new RecordingActions(workspace, simulation);
  onlySimulating_.push_back(
      workspace.menus.add(workspace.menus.simulate,
                          {nullptr,
                           tr("Export &deformed solid …"),
                           {},
                           tr("Write the deformed solid as patches, for CAD or further modelling")},
                          this, [this] { exportDeformed(workspace_, simulation_); }));
  new DeviceActions(workspace, simulation, options_, this);
  new Mouse3dControl(workspace, simulation, this);
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
  workspace_.tools.add(
      std::make_unique<ExactTouchTool>(workspace_, simulation_, options_),
      workspace_.menus.simulate,
      {"simulate-exact", tr("E&xact touch"), QKeySequence(Qt::Key_X),
       tr("Touch by numbers: kind, place, direction, depth or force; force–depth curve")},
      Mode::kSimulate);
  workspace_.tools.add(
      std::make_unique<SectionTool>(workspace_.settings, simulation_, section_, workspace_.view),
      workspace_.menus.simulate,
      {"section-plane", tr("Se&ction plane"), QKeySequence(Qt::Key_K),
       tr("Cut the body by a plane and show the field inside")},
      Mode::kSimulate);
  workspace_.tools.add(
      std::make_unique<SampleTool>(simulation_, samples_, workspace_.view),
      workspace_.menus.simulate,
      {"sample", tr("Sa&mple"), QKeySequence(Qt::Key_I),
       tr("Read displacement, stress and strain under the pointer; a click pins them")},
      Mode::kSimulate);
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
    if (info.quantity == app::SurfaceQuantity::kStiffnessGradient) gradientColours_ = action;
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

void SimulateActions::addSection() {
  Menus& menus = workspace_.menus;
  QAction* cut = menus.addToggle(
      menus.view, {nullptr, tr("Section"), {}, tr("Show the section plane of Simulate mode")},
      section_.isShown(), this, [this](bool on) { section_.setShown(on); });
  onlySimulating_.push_back(cut);
  connect(&section_, &SectionView::changed, cut, [this, cut] {
    const QSignalBlocker quiet(cut);
    cut->setChecked(section_.isShown());
  });
  menus
      .addToggle(menus.simulate,
                 {nullptr,
                  tr("&Minimum and maximum"),
                  {},
                  tr("Mark the smallest and the largest value of the surface")},
                 samples_.areExtremesShown(), this,
                 [this](bool on) {
                   samples_.setExtremesShown(on);
                   workspace_.settings.setExtremesShown(on);
                 })
      ->setChecked(workspace_.settings.areExtremesShown());
}

void SimulateActions::addGradient() {
  Editor& editor = workspace_.editor;
  gradientArrows_ = workspace_.menus.addToggle(
      workspace_.menus.view,
      {"gradient",
       tr("Gradient arrows"),
       {},
       tr("Arrows at the control points: pulled along them, they make the last touch stiffer")},
      false, this, [this, &editor](bool on) {
        editor.gradient().setArrowsShown(on);
        updateGradient();
      });
  // The menu shows tool tips.
  gradientColours_->setStatusTip(
      tr("Where added material makes the touch stiffer (red) or softer (blue)"));
  connect(&editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    if (change.supports || change.topology) updateGradient();
  });
  connect(&editor, &Editor::projectReplaced, this, &SimulateActions::updateGradient);
  updateGradient();
}

void SimulateActions::updateGradient() {
  const QString obstacle = workspace_.editor.gradient().obstacle();
  // What is shown can be hidden; the legend states the obstacle.
  setPossible(gradientArrows_, gradientArrows_->isChecked() ? QString() : obstacle);
  setPossible(gradientColours_, gradientColours_->isChecked() ? QString() : obstacle);
}

void SimulateActions::addColourRange() {
  using RangeMode = Simulation::RangeMode;
  Menus& menus = workspace_.menus;
  QMenu* ranges = menus.simulate->addMenu(tr("Colour ra&nge"));
  auto* group = new QActionGroup(this);
  const auto add = [&](const QString& text, const QString& tip, RangeMode mode) {
    QAction* action =
        menus.addToggle(ranges, {nullptr, text, {}, tip}, mode == RangeMode::kAutomatic, this,
                        [this, mode](bool on) {
                          if (on && mode != RangeMode::kManual) simulation_.setRangeMode(mode);
                          if (on) workspace_.settings.setColourRangeMode(static_cast<int>(mode));
                        });
    group->addAction(action);
    rangeModes_.push_back(action);
  };
  add(tr("&Automatic"), tr("Round numbers that enclose the values"), RangeMode::kAutomatic);
  add(tr("&Hold"), tr("Keep the present range while the values change"), RangeMode::kHold);
  add(tr("&Symmetric"), tr("The same distance to both sides of zero"), RangeMode::kSymmetric);
  add(tr("&Fixed …"), tr("Type the ends of the colours"), RangeMode::kManual);
  connect(rangeModes_.back(), &QAction::triggered, this, &SimulateActions::chooseRange);
  const auto restore = [this] {
    const int known = static_cast<int>(rangeModes_.size());
    const int mode = std::clamp(workspace_.settings.colourRangeMode(), 0, known - 1);
    const auto range = workspace_.settings.colourRange(simulation_.quantity());
    const bool isManual = mode == static_cast<int>(RangeMode::kManual) && range;
    const int chosen = mode == static_cast<int>(RangeMode::kManual) && !range ? 0 : mode;
    for (QAction* action : rangeModes_) action->blockSignals(true);
    rangeModes_[static_cast<std::size_t>(chosen)]->setChecked(true);
    for (QAction* action : rangeModes_) action->blockSignals(false);
    if (isManual)
      simulation_.setRangeMode(RangeMode::kManual, *range);
    else
      simulation_.setRangeMode(static_cast<RangeMode>(chosen));
  };
  restore();
  connect(&simulation_, &Simulation::quantityChanged, this, restore);
}

void SimulateActions::chooseRange() {
  const app::SurfaceQuantityInfo& info = app::infoOf(simulation_.quantity());
  const QString unit = info.unit;
  const Quantity quantity = unit == "mm"    ? Quantity::kLength
                            : unit == "MPa" ? Quantity::kStress
                                            : Quantity::kNumber;
  ColourRangeDialog dialog(
      quantity, workspace_.settings.colourRange(info.quantity).value_or(simulation_.range()),
      workspace_.settings, &workspace_.window);
  if (dialog.exec() == QDialog::Accepted) {
    // Fields show their values again when a setting changes.
    const std::array<double, 2> range = dialog.range();
    workspace_.settings.setColourRange(info.quantity, range);
    simulation_.setRangeMode(Simulation::RangeMode::kManual, range);
    return;
  }
  // As before.
  const int mode = static_cast<int>(simulation_.rangeMode());
  rangeModes_[static_cast<std::size_t>(mode)]->setChecked(true);
  workspace_.settings.setColourRangeMode(mode);
}

void SimulateActions::show(bool isActive) {
  (isActive ? simulate_ : model_)->setChecked(true);
  for (QAction* action : onlySimulating_) action->setEnabled(isActive);
  updatePlay();
  workspace_.tools.setMode(isActive ? Mode::kSimulate : Mode::kModel);
}

}  // namespace palpa::gui
