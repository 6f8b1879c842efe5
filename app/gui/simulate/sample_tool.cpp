#include "app/gui/simulate/sample_tool.h"

#include <utility>

namespace palpa::gui {

SampleTool::SampleTool(Simulation& simulation, Samples& samples, ViewportWidget& widget)
    : simulation_(simulation), samples_(samples), widget_(widget) {
  connect(&simulation, &Simulation::bodyChanged, this, &Tool::changed);
  connect(&simulation, &Simulation::waitingChanged, this, &Tool::changed);
  // Another project removes the pins.
  connect(&simulation, &Simulation::projectLeft, this, [this] { drag_.reset(); });
}

void SampleTool::deactivate() {
  cancel();
  samples_.hover(std::nullopt);
}

bool SampleTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  // A drag beside the body turns the view.
  if (!samples_.pinAt(event.pixel)) return false;
  drag_ = Drag{samples_.selected(), samples_.pin(samples_.selected()), event.pixel};
  return true;
}

bool SampleTool::move(const PointerEvent& event) {
  if (event.buttons == Qt::NoButton) samples_.hover(event.pixel);
  if (!drag_) return false;
  if (!drag_->hasBegun &&
      (event.pixel - drag_->from).norm() < kDragThreshold * widget_.devicePixelRatioF())
    return true;
  if (!std::exchange(drag_->hasBegun, true)) samples_.hover(std::nullopt);
  samples_.movePin(drag_->pin, event.pixel);
  return true;
}

bool SampleTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !drag_) return false;
  drag_.reset();
  widget_.setCursor(cursor());
  return true;
}

bool SampleTool::cancel() {
  if (!drag_) return false;
  const Drag drag = *std::exchange(drag_, std::nullopt);
  if (drag.hasBegun) samples_.setPin(drag.pin, drag.before);
  widget_.setCursor(cursor());
  return true;
}

void SampleTool::leave() {
  samples_.hover(std::nullopt);
}

bool SampleTool::wantsKey(const QKeyEvent& event) const {
  return event.key() == Qt::Key_Delete || event.key() == Qt::Key_Backspace ||
         event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
}

bool SampleTool::key(QKeyEvent* event) {
  if (!wantsKey(*event)) return false;
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    samples_.pinAt(samples_.pointer().value_or(Eigen::Vector2d(-1, -1)));
  } else {
    drag_.reset();
    samples_.removeSelected();
  }
  return true;
}

QString SampleTool::hint() const {
  if (!simulation_.drawn()) return simulation_.waitingHint();
  return tr(
      "Point at the body or the section; a click pins the sample, a drag moves it, Delete removes "
      "it");
}

KeyHelp SampleTool::keyHelp() const {
  return {tr("Sample"),
          {{tr("Pin or select a sample"), tr("Left button, Enter")},
           {tr("Move a sample"), tr("Drag with the left button")},
           {tr("Remove the selected sample"), tr("Delete")}}};
}

}  // namespace palpa::gui
