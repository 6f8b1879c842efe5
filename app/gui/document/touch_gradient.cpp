#include "app/gui/document/touch_gradient.h"

#include <QMetaObject>
#include <algorithm>
#include <utility>

#include "app/core/design/live_rule.h"
#include "app/core/system/destroy_in_background.h"
#include "app/gui/document/editor.h"
#include "app/view/scene/gradient_arrows.h"

namespace palpa::gui {
namespace {

/// Of the limits of isSameTouch(): the stiffness at rest then has the digits of the Forces panel.
constexpr double kAtRest = 0.01;
constexpr std::chrono::milliseconds kRest{300};  // without motion: the touch is at rest

const std::vector<Eigen::Vector3d>& pointsOfModel(const app::TouchModel& model) {
  return std::get<modeling::Solid>(model.body()).controlPoints();
}

/// Models and drawn bodies are large.
template <class Held>
void release(std::shared_ptr<Held>& held) {
  if (held) app::destroyInBackground(std::exchange(held, nullptr));
}

}  // namespace

TouchGradient::TouchGradient(Editor& editor)
    : QObject(&editor), editor_(editor), worker_([this](app::GradientWorker::Result result) {
        QMetaObject::invokeMethod(
            this, [this, result = std::move(result)] { receive(result); }, Qt::QueuedConnection);
      }) {
  connect(&editor, &Editor::aboutToReplace, this, &TouchGradient::forget);
  connect(&editor, &Editor::rebuildChanged, this, &TouchGradient::followModel);
  connect(&editor, &Editor::projectChanged, this, &TouchGradient::followModel);
}

QString TouchGradient::obstacle() const {
  return QString::fromStdString(app::gradientObstacle(editor_.project()));
}

void TouchGradient::setArrowsShown(bool shown) {
  if (shown == hasArrows_) return;
  hasArrows_ = shown;
  followModel();
  Q_EMIT changed();
}

void TouchGradient::setColoursShown(bool shown) {
  if (shown == hasColours_) return;
  hasColours_ = shown;
  followModel();
  Q_EMIT changed();
}

void TouchGradient::forget() {
  stop();
  leavePresent();
  releaseResults();
  release(drawn_);
  failed_.reset();
  rule_.reset();
  ruleSolid_.reset();
  problem_.clear();
  Q_EMIT changed();
}

bool TouchGradient::leavePresent() {
  const bool was = present_.model != nullptr;
  release(present_.model);
  present_ = {};
  return was;
}

void TouchGradient::stop() {
  if (flight_) worker_.clear();
  flight_.reset();
}

void TouchGradient::releaseResults() {
  if (known_) {
    release(known_->model);
    release(known_->drawn);
  }
  if (measured_) release(measured_->model);
  known_.reset();
  measured_.reset();
}

void TouchGradient::followModel() {
  if (!hasArrows_ && !hasColours_) {
    // The touch and the gradient stay; nothing is computed.
    stop();
    leavePresent();
    return;
  }
  const app::RebuildStatus status = editor_.rebuildStatus();
  const bool isBuilding = status.state == app::RebuildStatus::State::kBuilding;
  if (std::exchange(isBuilding_, isBuilding) != isBuilding) Q_EMIT changed();
  const auto model = editor_.model();
  const bool isPresent = model && status.modelRevision == status.revision && editor_.solid() &&
                         std::holds_alternative<modeling::Solid>(model->body());
  if (!isPresent) {
    if (leavePresent()) Q_EMIT changed();
    return;
  }
  if (present_.model != model) {
    leavePresent();
    present_.model = model;
    present_.project = std::make_shared<const modeling::Project>(editor_.project());
    present_.solid = std::make_shared<const modeling::Solid>(*editor_.solid());
    Q_EMIT changed();
  }
  update();
}

void TouchGradient::follow(app::StiffnessRule rule, std::shared_ptr<const app::DrawnBody> drawn) {
  // Otherwise the touch is still on the former model, whose solid is known.
  if (present_.model && present_.model.get() == &drawn->model()) ruleSolid_ = present_.solid;
  const bool isOther = !rule_ || rule_->name != rule.name;
  if (isOther || !app::isSameTouch(*rule_, rule, kAtRest))
    moved_ = std::chrono::steady_clock::now();
  const bool isSame = !isOther && drawn == drawn_ && app::isSameTouch(*rule_, rule);
  const bool wasOutdated = isOutdated();
  rule_ = std::move(rule);
  if (drawn_ != drawn) release(drawn_);
  drawn_ = std::move(drawn);
  update();
  if (!isSame || wasOutdated != isOutdated()) Q_EMIT changed();
}

void TouchGradient::leaveView() {
  if (!drawn_) return;
  release(drawn_);
  if (known_) {
    release(known_->drawn);
    known_->surface.clear();
  }
  update();
  Q_EMIT changed();
}

bool TouchGradient::isUpToDate() const {
  if (!known_ || known_->model != present_.model) return false;
  if (hasColours_ && drawn_ && known_->drawn != drawn_) return false;
  // While the touch moves the gradient may lag a little behind.
  const bool isMoving = drawn_ && std::chrono::steady_clock::now() - moved_ < kRest;
  return app::isSameTouch(*rule_, known_->rule, isMoving ? 1 : kAtRest) &&
         rule_->name == known_->rule.name;
}

bool TouchGradient::isOutdated() const {
  if (!known_) return false;
  return !rule_ || known_->model != present_.model || rule_->name != known_->rule.name ||
         !app::isSameTouch(*rule_, known_->rule);
}

void TouchGradient::update() {
  if (!rule_ || !present_.model || !ruleSolid_ || !obstacle().isEmpty()) return;
  if (drawn_ && &drawn_->model() != present_.model.get()) return;  // until it shows the new model
  const bool hasGradient = !present_.model->report().residual;
  if (hasGradient ? isUpToDate() : measured_ && measured_->model == present_.model) return;
  const auto isSameRequest = [this](const std::optional<Flight>& other) {
    return other && other->request.model == present_.model &&
           other->request.rule.name == rule_->name;
  };
  if (isSameRequest(flight_)) return;  // its result asks for the next one
  if (isSameRequest(failed_) && app::isSameTouch(failed_->request.rule, *rule_)) return;
  app::GradientWorker::Request request{present_.model, present_.project, *rule_, nullptr,
                                       hasColours_ ? drawn_ : nullptr};
  const bool isCarried = ruleSolid_ != present_.solid;
  if (isCarried && ruleSolid_->controlPoints().size() == present_.solid->controlPoints().size())
    request.from = ruleSolid_;
  const std::uint64_t number = worker_.start(request);
  flight_ = Flight{number, std::move(request)};
}

void TouchGradient::receive(const app::GradientWorker::Result& result) {
  if (!flight_ || result.number != flight_->number) return;
  const app::GradientWorker::Request& request = flight_->request;
  const std::string name = request.rule.name;
  problem_ = QString::fromStdString(result.problem);
  if (!result.problem.empty()) {
    failed_ = std::move(flight_);
    flight_.reset();
    Q_EMIT changed();
    return;
  }
  failed_.reset();
  const bool isWhole = result.gradient.cols() > 0;
  if (measured_) release(measured_->model);
  measured_ = Measured{request.model, result.stiffness};
  if (isWhole && known_) {
    release(known_->model);
    release(known_->drawn);
  }
  if (isWhole)
    known_ = Known{result.rule,   result.stiffness, result.gradient, result.surface,
                   request.drawn, request.model,    result.seconds};
  if (isWhole && ruleSolid_ != present_.solid && !drawn_ && request.model == present_.model) {
    // The touch has moved along with the edit.
    rule_ = result.rule;
    ruleSolid_ = present_.solid;
  }
  if (isWhole || request.model->report().residual) {
    flight_.reset();
    update();
  }
  Q_EMIT changed();
}

std::optional<TouchGradient::Stiffness> TouchGradient::stiffness() const {
  if (!known_ || !rule_ || !app::isSameTouch(*rule_, known_->rule, kAtRest)) return std::nullopt;
  const Measured from = measured_.value_or(Measured{known_->model, known_->stiffness});
  if (from.model == present_.model) return Stiffness{from.stiffness, false};
  if (!editor_.solid()) return std::nullopt;
  const auto& now = editor_.solid()->controlPoints();
  const auto& before = pointsOfModel(*from.model);
  if (now.size() != before.size() ||
      static_cast<Eigen::Index>(now.size()) != known_->gradient.cols())
    return std::nullopt;
  Stiffness stiffness{from.stiffness, true};
  for (std::size_t k = 0; k < now.size(); ++k)
    stiffness.value += known_->gradient.col(static_cast<Eigen::Index>(k)).dot(now[k] - before[k]);
  return stiffness;
}

std::optional<Eigen::Vector3d> TouchGradient::directionOf(const std::set<int>& points) const {
  if (!hasArrows_ || !known_ || points.size() != 1) return std::nullopt;
  const std::vector<int> drawn = view::pointsWithArrows(known_->gradient);
  if (!std::binary_search(drawn.begin(), drawn.end(), *points.begin())) return std::nullopt;
  return known_->gradient.col(*points.begin()).normalized();
}

}  // namespace palpa::gui
