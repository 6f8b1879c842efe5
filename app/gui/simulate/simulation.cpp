#include "app/gui/simulate/simulation.h"

#include <QMetaObject>
#include <algorithm>
#include <cmath>

#include "app/core/priority.h"
#include "app/core/release.h"
#include "bem/error.h"

namespace palpa::gui {
namespace {

constexpr int kFrame = 16;          // ms between two frames at most
constexpr double kHeadroom = 0.25;  // a range this much too large is made smaller

/// The smallest of 1, 2, 5 times a power of ten that is not below `value` > 0.
double roundUp(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace

Simulation::Simulation(Editor& editor, QObject* parent) : QObject(parent), editor_(editor) {
  timer_.setInterval(kFrame);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &Simulation::frame);
  connect(&editor, &Editor::rebuildChanged, this, &Simulation::followModel);
  connect(&editor, &Editor::projectReplaced, this, [this] {
    if (isActive()) letGoOfAll();
  });
}

Simulation::~Simulation() = default;

void Simulation::setActive(bool active) {
  if (active == isActive()) return;
  if (active) {
    if (!loop_) loop_ = std::make_unique<app::TouchLoop>();
    timer_.start();
    followModel();
  } else {
    Q_EMIT leaving();
    timer_.stop();
    isLive_ = true;
    letGoOfAll();
    loop_->setModel(nullptr);
    maker_ = {};
    model_.reset();
    drawn_.reset();
    field_.reset();
    drawnNumber_ = wantedNumber_ = lastStep_ = 0;
    snapshot_ = {};
  }
  Q_EMIT activeChanged(active);
}

void Simulation::followModel() {
  if (!isActive() || editor_.model() == model_) return;
  model_ = editor_.model();
  loop_->setModel(model_);
}

std::optional<app::TouchId> Simulation::begin(const bem::ContactTool& tool,
                                              const Eigen::Vector3d& at,
                                              const Eigen::Vector3d& value) {
  try {
    return loop_->begin(tool, at, value);
  } catch (const app::TouchRefused& refused) {
    Q_EMIT editor_.refused(QString::fromStdString(refused.what()));
    return std::nullopt;
  }
}

void Simulation::letGoOfAll() {
  for (const auto& contact : snapshot_.touched()) loop_->end(contact.id);
}

void Simulation::setQuantity(app::SurfaceQuantity quantity) {
  if (quantity == quantity_) return;
  quantity_ = quantity;
  range_ = {0, 0};
  isDirty_ = true;
  Q_EMIT picturesChanged();
}

void Simulation::setScale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  isDirty_ = true;
  Q_EMIT picturesChanged();
}

bool Simulation::isBehind() const {
  return editor_.rebuildStatus().state != app::RebuildStatus::State::kUpToDate ||
         snapshot_.model != loop_->status().newest;
}

std::shared_ptr<const app::TouchBody> Simulation::body() const {
  return field_ ? field_->body() : nullptr;
}

std::optional<app::TouchState> Simulation::describe() {
  if (!field_ || snapshot_.model != drawnNumber_) return std::nullopt;
  return field_->describe(snapshot_);
}

Eigen::Vector3d Simulation::displacementAt(const bem::SurfacePoint& point) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (!drawn_ || displacements_.size() == 0) return sum;
  const auto& corners =
      drawn_->model().setup().mesh.triangles[static_cast<std::size_t>(point.triangle)];
  for (int k = 0; k < 3; ++k)
    sum += point.weights[k] * displacements_.segment<3>(3 * corners[static_cast<std::size_t>(k)]);
  return sum;
}

void Simulation::show(const app::TouchSnapshot& snapshot) {
  if (!drawn_) return;
  snapshot_ = snapshot;
  evaluate();
  Q_EMIT framed();
}

void Simulation::showLive() {
  isLive_ = true;
  isDirty_ = true;
}

void Simulation::frame() {
  if (!isLive_) return;
  loop_->read(snapshot_);
  if (snapshot_.model != drawnNumber_) {
    // Until the new body is drawn the picture stays as it is.
    if (snapshot_.model != 0 && snapshot_.model != wantedNumber_) makeDrawn(snapshot_.model);
    return;
  }
  const bool isTouched = snapshot_.contactCount > 0;
  if (!drawn_ || (!isDirty_ && !isTouched && !wasTouched_)) return;
  if (!isDirty_ && snapshot_.step == lastStep_) return;
  isDirty_ = false;
  wasTouched_ = isTouched;
  lastStep_ = snapshot_.step;
  evaluate();
  Q_EMIT framed();
}

void Simulation::makeDrawn(std::uint64_t number) {
  const auto body = loop_->body(number);
  if (!body) return;  // another one comes
  wantedNumber_ = number;
  maker_ = std::jthread([this, number, body](const std::stop_token& stop) {
    app::lowerThreadPriority();
    bem::Job job;
    job.stop = stop;
    try {
      auto drawn = std::make_shared<const app::DrawnBody>(body->sharedModel(), job);
      auto field = std::make_shared<std::unique_ptr<app::TouchField>>(
          std::make_unique<app::TouchField>(body));
      QMetaObject::invokeMethod(
          this, [this, number, drawn, field] { adopt(number, drawn, std::move(*field)); },
          Qt::QueuedConnection);
    } catch (const bem::Cancelled&) {
      // The mode was left, or a newer body came.
    }
  });
}

void Simulation::adopt(std::uint64_t number, std::shared_ptr<const app::DrawnBody> drawn,
                       std::unique_ptr<app::TouchField> field) {
  if (!isActive() || number != wantedNumber_) return;
  if (!isLive_) {
    wantedNumber_ = 0;  // made again then
    return;
  }
  if (field_) app::releaseElsewhere(std::shared_ptr<app::TouchField>(std::move(field_)));
  if (drawn_) app::releaseElsewhere(std::move(drawn_));
  field_ = std::move(field);
  drawn_ = std::move(drawn);
  drawnNumber_ = number;
  range_ = {0, 0};
  loop_->read(snapshot_);
  if (snapshot_.model != number) return;  // already the next one
  evaluate();
  Q_EMIT bodyChanged();
  Q_EMIT framed();
}

void Simulation::evaluate() {
  const bool needsTractions = quantity_ == app::SurfaceQuantity::kNormalTraction ||
                              quantity_ == app::SurfaceQuantity::kVonMises;
  if (needsTractions) {
    const bem::BoundaryField& field = field_->field(snapshot_);
    displacements_ = field.u.col(0);
    values_ = drawn_->values(quantity_, field);
  } else {
    displacements_ = field_->displacements(snapshot_).col(0);
    values_ = quantity_ == app::SurfaceQuantity::kNone ? std::vector<double>()
                                                       : drawn_->displacementSizes(displacements_);
  }
  drawn_->deform(displacements_, scale_, shape_);
  updateRange();
}

void Simulation::updateRange() {
  if (values_.empty()) return;
  double largest = 0;
  for (const double value : values_) largest = std::max(largest, std::abs(value));
  if (largest == 0) largest = 1e-9;
  // Steady while one presses harder; the person compares colours over time.
  const double present = range_[1];
  if (largest > present || largest < kHeadroom * present || present == 0)
    range_[1] = roundUp(largest);
  range_[0] = quantity_ == app::SurfaceQuantity::kNormalTraction ? -range_[1] : 0;
}

}  // namespace palpa::gui
