#include "app/gui/simulate/shown_stiffness.h"

#include <QMetaObject>

#include "app/core/results/touch.h"

namespace palpa::gui {

ShownStiffness::ShownStiffness(QObject* parent)
    : QObject(parent), worker_([this](app::StiffnessWorker::Result result) {
        QMetaObject::invokeMethod(
            this, [this, result = std::move(result)] { receive(result); }, Qt::QueuedConnection);
      }) {}

bool ShownStiffness::setFingertip(double radius) {
  if (fingertip_ == radius) return false;
  fingertip_ = radius;
  return true;
}

void ShownStiffness::start(std::shared_ptr<const app::TouchableModel> body,
                           std::shared_ptr<const app::DrawnBody> drawn) {
  clear();
  body_ = std::move(body);
  drawn_ = std::move(drawn);
  radius_ = fingertip_.value_or(app::defaultTouchRadius(body_->model().setup().mesh()));
  worker_.start(body_, radius_);
}

void ShownStiffness::stop() {
  worker_.stop();
  body_.reset();
  drawn_.reset();
}

void ShownStiffness::clear() {
  stop();
  values_.clear();
  ready_ = 0;
}

void ShownStiffness::receive(const app::StiffnessWorker::Result& result) {
  // The event may have been queued before stop() or another start().
  if (!body_ || result.model != body_ || result.radius != radius_) return;
  const app::BoundarySetup& setup = result.model->model().setup();
  values_ = drawn_->stiffnesses(result.compliances);
  colours_ = app::StiffnessColours::of(setup.mesh(), setup.meshSlots(), result.compliances);
  colours_.cap(values_);
  ready_ = result.ready;
  Q_EMIT grown();
}

}  // namespace palpa::gui
