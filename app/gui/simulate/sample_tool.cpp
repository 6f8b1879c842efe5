#include "app/gui/simulate/sample_tool.h"

namespace palpa::gui {

SampleTool::SampleTool(Simulation& simulation, Samples& samples, ViewportWidget& widget)
    : simulation_(simulation), samples_(samples), widget_(widget) {
  connect(&simulation, &Simulation::bodyChanged, this, &Tool::changed);
  connect(&simulation, &Simulation::waitingChanged, this, &Tool::changed);
}

void SampleTool::deactivate() {
  samples_.hover(std::nullopt);
}

bool SampleTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  // A drag beside the body turns the view.
  return samples_.pinAt(event.pixel);
}

bool SampleTool::move(const PointerEvent& event) {
  if (event.buttons == Qt::NoButton) samples_.hover(event.pixel);
  return false;
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
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
    samples_.pinAt(samples_.pointer().value_or(Eigen::Vector2d(-1, -1)));
  else
    samples_.removeSelected();
  return true;
}

QString SampleTool::hint() const {
  if (!simulation_.drawn()) return simulation_.waitingHint();
  return tr("Point at the body or the section; a click pins the sample, Delete removes it");
}

KeyHelp SampleTool::keyHelp() const {
  return {tr("Sample"),
          {{tr("Pin or select a sample"), tr("Left button, Enter")},
           {tr("Remove the selected sample"), tr("Delete")}}};
}

}  // namespace palpa::gui
