#include "app/gui/simulate/exact_touch_tool.h"

#include "app/gui/document/editor.h"
#include "app/gui/simulate/exact_touch_options.h"
#include "app/gui/simulate/surface_pick.h"
#include "app/gui/simulate/sweep_dialog.h"

namespace palpa::gui {
namespace {

using Style = view::ToolDrawing::Style;

}  // namespace

ExactTouchTool::ExactTouchTool(const Workspace& workspace, Simulation& simulation,
                               SimulateOptions& options)
    : workspace_(workspace), simulation_(simulation), touch_(workspace, simulation, options) {
  connect(&touch_, &ExactTouch::changed, this, [this] {
    draw();
    Q_EMIT changed();
  });
  connect(&simulation, &Simulation::framed, this, [this] { draw(); });
}

void ExactTouchTool::activate() {
  isActive_ = true;
  draw();
}

void ExactTouchTool::deactivate() {
  touch_.release();
  isActive_ = false;
  workspace_.view.viewport().setToolDrawing({});
}

bool ExactTouchTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  if (const auto pick = pickSurface(simulation_, workspace_.view, event.pixel))
    touch_.setPlace(pick->at);
  return true;
}

bool ExactTouchTool::release(const PointerEvent& event) {
  return event.button == Qt::LeftButton;
}

bool ExactTouchTool::move(const PointerEvent& event) {
  const auto pick = pickSurface(simulation_, workspace_.view, event.pixel);
  if (pick) simulation_.expect(pick->at);
  draw(pick ? std::optional(pick->drawn) : std::nullopt);
  return false;
}

void ExactTouchTool::leave() {
  draw();
}

void ExactTouchTool::draw(const std::optional<Eigen::Vector3d>& hovered) {
  if (!isActive_) return;
  view::ToolDrawing drawing;
  if (touch_.isComplete()) {
    const bem::SurfacePoint place = simulation_.body()->surface().tree().nearest(*touch_.place());
    const Eigen::Vector3d at =
        place.position + simulation_.scale() * simulation_.displacementAt(place);
    const Eigen::Vector3d reach = touch_.radius() * touch_.unit();
    drawing.dots.push_back({at, Style::kSelected});
    // The line ends at the place where the touch presses, and begins there where it pulls.
    const bool isPressing = touch_.unit().dot(simulation_.body()->surface().normal(
                                simulation_.body()->surface().nearest(*touch_.place()))) < 0;
    drawing.lines.push_back(
        {{isPressing ? at - reach : at, isPressing ? at : at + reach}, Style::kPreview, false});
  }
  if (hovered) drawing.dots.push_back({*hovered, Style::kPreview});
  workspace_.view.viewport().setToolDrawing(drawing);
  workspace_.view.update();
}

bool ExactTouchTool::cancel() {
  if (touch_.release()) return true;
  if (!simulation_.isActive() || simulation_.snapshot().contactCount == 0) return false;
  simulation_.endAll();
  return true;
}

QString ExactTouchTool::hint() const {
  if (!simulation_.drawn()) return simulation_.waitingHint();
  if (!touch_.place()) return tr("Click the place to touch, or type it in Properties");
  if (touch_.isApplied()) return tr("Escape ends the touch; Keep as pin leaves it");
  return tr("Apply in Properties touches the place; a click chooses another one");
}

KeyHelp ExactTouchTool::keyHelp() const {
  return {tr("Simulate"), {{tr("Place of an exact touch"), tr("Left button")}}};
}

QWidget* ExactTouchTool::makeOptions(QWidget* parent) {
  return new ExactTouchOptions(
      touch_, workspace_.settings, [this] { openSweep(); }, parent);
}

void ExactTouchTool::openSweep() {
  if (!touch_.isComplete()) return;
  auto* dialog = new SweepDialog(workspace_, simulation_.body()->sharedModel(), touch_.touch());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->show();
}

}  // namespace palpa::gui
