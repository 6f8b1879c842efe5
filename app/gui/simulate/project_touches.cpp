#include "app/gui/simulate/project_touches.h"

#include <algorithm>

#include "app/core/model/contact_kind.h"
#include "app/core/results/touch.h"

namespace palpa::gui {
namespace {

using Kind = bem::ContactTool::Kind;

constexpr int kFrame = 10;       // ms between two steps
constexpr double kTime = 1000;   // ms until a touch has its stored value
constexpr double kSettle = 200;  // ms until the drawn surface has settled

}  // namespace

ProjectTouches::ProjectTouches(const Editor& editor, Simulation& simulation, QObject* parent)
    : QObject(parent), editor_(editor), simulation_(simulation) {
  timer_.setInterval(kFrame);
  connect(&timer_, &QTimer::timeout, this, &ProjectTouches::advance);
  connect(&simulation, &Simulation::leaving, &timer_, &QTimer::stop);
  connect(&editor, &Editor::projectReplaced, &timer_, &QTimer::stop);
}

void ProjectTouches::play() {
  if (!simulation_.drawn()) return;
  simulation_.endAll();
  begin(false);
  timer_.start();
}

void ProjectTouches::begin(bool pressing) {
  isPressing_ = pressing;
  motions_.clear();
  for (const modeling::Touch& touch : editor_.project().touches) {
    if (modeling::infoOf(touch.kind).presses != pressing) continue;
    if (const auto motion = begin(touch)) motions_.push_back(*motion);
  }
  since_.start();
}

std::optional<ProjectTouches::Motion> ProjectTouches::begin(const modeling::Touch& touch) {
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
    // Where the tool first meets the surface, as moveTools() has it.
    const bem::ContactSurface& surface = simulation_.body()->surface();
    from = surface.smoothPosition(place) + simulation_.displacementAt(place);
    if (app::infoOf(tool.kind).isBall) from += tool.radius * surface.normal(place);
    to += from;
  }
  const auto id = simulation_.begin(tool, touch.at, from);
  if (!id) return std::nullopt;
  return Motion{*id, from, to - from};
}

bool ProjectTouches::isSettled() const {
  return std::all_of(motions_.begin(), motions_.end(), [this](const Motion& motion) {
    const auto* contact = simulation_.snapshot().find(motion.id);
    // Do not wait for contacts that the user has ended.
    if (!contact) return true;
    return contact->status != app::TouchSnapshot::Status::kWaiting &&
           (contact->value - motion.from - motion.by).norm() < 1e-9;
  });
}

void ProjectTouches::advance() {
  const auto elapsed = static_cast<double>(since_.elapsed());
  const double share = motions_.empty() ? 1.0 : std::min(1.0, elapsed / kTime);
  // The loop ignores contacts that the user has ended.
  for (const Motion& motion : motions_)
    simulation_.move(motion.id, motion.from + share * motion.by);
  if (share < 1) return;
  if (isPressing_)
    timer_.stop();
  else if (elapsed > (motions_.empty() ? 0 : kTime) + kSettle && isSettled())
    begin(true);  // on the deformed surface
}

}  // namespace palpa::gui
