#include "app/gui/simulate/project_touches.h"

#include <algorithm>

#include "app/core/results/touch.h"

namespace palpa::gui {
namespace {

using Kind = bem::ContactTool::Kind;

constexpr int kFrame = 10;       // ms between two steps
constexpr double kTime = 1000;   // ms until a touch is where the project says
constexpr double kSettle = 200;  // ms until the surface is drawn as touches leave it

Kind toolKind(const modeling::Touch& touch) {
  if (std::holds_alternative<modeling::TouchForce>(touch.action)) return Kind::kForce;
  if (std::holds_alternative<modeling::TouchPush>(touch.action)) return Kind::kPush;
  if (std::holds_alternative<modeling::TouchProbe>(touch.action)) return Kind::kProbe;
  return Kind::kGrab;
}

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
  simulation_.letGoOfAll();
  begin(false);
  timer_.start();
}

void ProjectTouches::begin(bool pressing) {
  isPressing_ = pressing;
  motions_.clear();
  for (const modeling::Touch& touch : editor_.project().touches) {
    const Kind kind = toolKind(touch);
    const bool presses = kind == Kind::kPush || kind == Kind::kProbe;
    if (presses != pressing) continue;
    if (const auto motion = begin(touch, kind)) motions_.push_back(*motion);
  }
  since_.start();
}

std::optional<ProjectTouches::Motion> ProjectTouches::begin(const modeling::Touch& touch,
                                                            Kind kind) {
  const app::TouchModel& model = simulation_.drawn()->model();
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const double* friction = modeling::frictionOf(touch);
  const bem::ContactTool tool{kind, touch.radius.value_or(app::defaultTouchRadius(mesh)),
                              friction ? *friction : 0.0};
  const bem::SurfacePoint place = simulation_.body()->surface().tree().nearest(touch.at);
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = modeling::vectorOf(touch);
  if (kind == Kind::kGrab) {
    from = model.setup().discretisation->interpolate(place,
                                                     Eigen::VectorXd(model.rest().field.u.col(0)));
    if (std::holds_alternative<modeling::TouchPin>(touch.action)) to += from;
  } else if (kind != Kind::kForce) {
    // Where the tool first meets the surface, as moveTools() has it.
    const bem::ContactSurface& surface = simulation_.body()->surface();
    from = surface.smoothPosition(place) + simulation_.displacementAt(place);
    if (kind == Kind::kProbe) from += tool.radius * surface.normal(place);
    to += from;
  }
  const auto id = simulation_.begin(tool, touch.at, from);
  if (!id) return std::nullopt;
  return Motion{*id, from, to - from};
}

bool ProjectTouches::isSettled() const {
  return std::all_of(motions_.begin(), motions_.end(), [this](const Motion& motion) {
    const auto* contact = simulation_.snapshot().find(motion.id);
    // What was let go meanwhile is waited for no longer.
    if (!contact) return true;
    return contact->status != app::TouchSnapshot::Status::kWaiting &&
           (contact->value - motion.from - motion.way).norm() < 1e-9;
  });
}

void ProjectTouches::advance() {
  const auto elapsed = static_cast<double>(since_.elapsed());
  const double share = motions_.empty() ? 1.0 : std::min(1.0, elapsed / kTime);
  // What was let go meanwhile is ignored by the loop.
  for (const Motion& motion : motions_)
    simulation_.move(motion.id, motion.from + share * motion.way);
  if (share < 1) return;
  if (isPressing_)
    timer_.stop();
  else if (elapsed > (motions_.empty() ? 0 : kTime) + kSettle && isSettled())
    begin(true);  // the surface is drawn where the others hold it
}

}  // namespace palpa::gui
