#include "app/gui/simulate/touch_motion.h"

#include <algorithm>

#include "app/core/model/contact_kind.h"
#include "app/core/results/touch.h"

namespace palpa::gui {
namespace {

using Kind = bem::ContactTool::Kind;

constexpr int kMotionInterval = 10;  // ms between two steps
constexpr double kTime = 1000;       // ms until a touch has its value
constexpr double kSettle = 200;      // ms until the drawn surface has settled

}  // namespace

TouchMotion::TouchMotion(Simulation& simulation, QObject* parent)
    : QObject(parent), simulation_(simulation) {
  timer_.setInterval(kMotionInterval);
  connect(&timer_, &QTimer::timeout, this, &TouchMotion::advance);
  connect(&simulation, &Simulation::leaving, this, &TouchMotion::stop);
}

std::optional<app::TouchId> TouchMotion::begin(const modeling::Touch& touch) {
  if (!simulation_.drawn()) return std::nullopt;
  const app::TouchModel& model = simulation_.drawn()->model();
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const bem::ContactTool tool{app::contactKindOf(touch.kind),
                              touch.radius.value_or(app::defaultTouchRadius(mesh)), touch.friction};
  const bem::SurfacePoint place = simulation_.body()->surface().tree().nearest(touch.at);
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = touch.vector;
  if (tool.kind == Kind::kGrab) {
    from = model.setup().discretisation->interpolate(place,
                                                     Eigen::VectorXd(model.rest().field.u.col(0)));
    if (touch.kind == modeling::TouchKind::kPin) to += from;
  } else if (tool.presses()) {
    // From where the tool first meets the surface, as in moveTools().
    const bem::ContactSurface& surface = simulation_.body()->surface();
    from = surface.smoothPosition(place) + simulation_.displacementAt(place);
    if (app::infoOf(tool.kind).isBall) from += tool.radius * surface.normal(place);
    to += from;
  }
  const auto id = simulation_.begin(tool, touch.at, from);
  if (!id) return std::nullopt;
  motions_.push_back({*id, from, to - from, {}});
  motions_.back().since.start();
  timer_.start();
  return id;
}

void TouchMotion::stop() {
  motions_.clear();
  timer_.stop();
}

bool TouchMotion::isSettled() const {
  return std::all_of(motions_.begin(), motions_.end(), [this](const Motion& motion) {
    const auto* contact = simulation_.snapshot().find(motion.id);
    // Do not wait for contacts that the user has ended.
    if (!contact) return simulation_.hasEnded(motion.id) || motion.since.elapsed() > kTime;
    return motion.since.elapsed() > kTime + kSettle &&
           contact->status != app::TouchSnapshot::Status::kWaiting &&
           (contact->value - motion.from - motion.by).norm() < 1e-9;
  });
}

void TouchMotion::advance() {
  bool isMoving = false;
  for (const Motion& motion : motions_) {
    // The loop ignores contacts that the user has ended.
    const double share = std::min(1.0, static_cast<double>(motion.since.elapsed()) / kTime);
    simulation_.move(motion.id, motion.from + share * motion.by);
    isMoving = isMoving || share < 1;
  }
  if (!isMoving) timer_.stop();
}

}  // namespace palpa::gui
