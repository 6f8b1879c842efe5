#include "app/gui/dialogs/fit_measurement.h"

#include <QThreadPool>
#include <atomic>
#include <exception>

#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
namespace {

constexpr int kMeasureInterval = 100;  // ms between two checks for the answer

}  // namespace

struct FitMeasurement::Answer {
  double deviation = -1;  // mm; negative if the shape cannot be made
  std::atomic<bool> isThere = false;
};

FitMeasurement::FitMeasurement(QObject* parent) : QObject(parent) {
  timer_.setInterval(kMeasureInterval);
  connect(&timer_, &QTimer::timeout, this, &FitMeasurement::look);
}

void FitMeasurement::ask(const modeling::Primitive& primitive) {
  waiting_ = primitive;
  isWanted_ = false;  // the running measurement is outdated
  timer_.start();
}

void FitMeasurement::forget() {
  waiting_.reset();
  isWanted_ = false;
}

void FitMeasurement::look() {
  if (answer_) {
    if (!answer_->isThere) return;
    if (isWanted_ && answer_->deviation >= 0) Q_EMIT measured(answer_->deviation);
    answer_.reset();
  }
  if (!waiting_) {
    timer_.stop();
    return;
  }
  answer_ = std::make_shared<Answer>();
  QThreadPool::globalInstance()->start([answer = answer_, primitive = *waiting_] {
    try {
      answer->deviation = modeling::makeMeasuredPrimitive(primitive).deviation;
    } catch (const std::exception&) {
      // The dialog has already shown the error.
    }
    answer->isThere = true;
  });
  waiting_.reset();
  isWanted_ = true;
}

}  // namespace palpa::gui
