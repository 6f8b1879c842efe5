#include "app/gui/simulate/exact_touch.h"

#include <utility>

#include "app/core/results/field_sample.h"
#include "app/core/results/touch.h"
#include "app/gui/document/named_items.h"
#include "bem/base/error.h"

namespace palpa::gui {
namespace {

/// Depth at first, over the radius.
constexpr double kDepthShare = 0.1;

}  // namespace

ExactTouch::ExactTouch(const Workspace& workspace, Simulation& simulation, SimulateOptions& options)
    : workspace_(workspace), simulation_(simulation), options_(options), motion_(simulation, this) {
  connect(&simulation, &Simulation::bodyChanged, this, &ExactTouch::changed);
  connect(&simulation, &Simulation::leaving, this, [this] { applied_ = leaving_ = 0; });
  connect(&simulation, &Simulation::framed, this, [this] {
    if (leaving_ == 0 || simulation_.snapshot().find(leaving_)) return;
    leaving_ = 0;
    begin();
  });
  connect(&options, &SimulateOptions::changed, this, &ExactTouch::changed);
  connect(&workspace.editor, &Editor::projectReplaced, this, [this] {
    applied_ = leaving_ = 0;
    place_.reset();
    depth_.reset();
    force_.reset();
    Q_EMIT changed();
  });
}

void ExactTouch::setKind(modeling::TouchKind kind) {
  kind_ = kind;
  Q_EMIT changed();
}

void ExactTouch::setPlace(const Eigen::Vector3d& place) {
  place_ = place;
  Q_EMIT changed();
}

void ExactTouch::setDirection(Direction direction) {
  direction_ = direction;
  Q_EMIT changed();
}

void ExactTouch::setVector(const Eigen::Vector3d& vector) {
  vector_ = vector;
  Q_EMIT changed();
}

double ExactTouch::radius() const {
  return simulation_.drawn() ? options_.radius(*simulation_.drawn()) : 0;
}

double ExactTouch::depth() const {
  return depth_.value_or(modeling::infoOf(kind_).needsVector ? kDepthShare * radius() : 0.0);
}

void ExactTouch::setDepth(double depth) {
  depth_ = depth;
  Q_EMIT changed();
}

double ExactTouch::force() const {
  return force_.value_or(1);
}

void ExactTouch::setForce(double force) {
  force_ = force;
  Q_EMIT changed();
}

Eigen::Vector3d ExactTouch::unit() const {
  const auto normal = [this] {
    const bem::ContactSurface& surface = simulation_.body()->surface();
    return surface.normal(surface.nearest(*place_));
  };
  switch (direction_) {
    case Direction::kInwards:
      return -normal();
    case Direction::kOutwards:
      return normal();
    case Direction::kX:
      return Eigen::Vector3d::UnitX();
    case Direction::kMinusX:
      return -Eigen::Vector3d::UnitX();
    case Direction::kY:
      return Eigen::Vector3d::UnitY();
    case Direction::kMinusY:
      return -Eigen::Vector3d::UnitY();
    case Direction::kZ:
      return Eigen::Vector3d::UnitZ();
    case Direction::kMinusZ:
      return -Eigen::Vector3d::UnitZ();
    case Direction::kVector:
      return vector_.stableNormalized();
  }
  return Eigen::Vector3d::Zero();
}

modeling::Touch ExactTouch::touch() const {
  const modeling::TouchKindInfo& info = modeling::infoOf(kind_);
  modeling::Touch touch;
  touch.name = "touch";
  touch.at = *place_;
  touch.kind = kind_;
  touch.vector = (info.isForce ? force() : depth()) * unit();
  touch.radius = radius();
  touch.friction = info.presses ? friction() : 0;
  return touch;
}

bool ExactTouch::checkPlace() const {
  try {
    app::checkNearSurface(simulation_.drawn()->model().setup().mesh(), *place_,
                          tr("the place of the touch").toStdString());
    return true;
  } catch (const bem::SolverError& error) {
    QString message = QString::fromStdString(error.what());
    message[0] = message[0].toUpper();
    Q_EMIT workspace_.editor.refused(message);
    return false;
  }
}

bool ExactTouch::isApplied() const {
  return leaving_ != 0 || (applied_ != 0 && !simulation_.hasEnded(applied_));
}

bool ExactTouch::apply() {
  if (!isComplete() || !checkPlace()) return false;
  if (leaving_ != 0) return true;  // begins with the present numbers
  const app::TouchId former = applied_;
  isKeptLater_ = false;
  // A tool presses from where it first meets the surface, which is not yet the drawn one.
  if (release() && simulation_.snapshot().find(former)) {
    leaving_ = former;
    Q_EMIT changed();
    return true;
  }
  return begin();
}

bool ExactTouch::begin() {
  if (!isComplete()) return false;
  applied_ = motion_.begin(touch()).value_or(0);
  const bool hasBegun = applied_ != 0;
  if (std::exchange(isKeptLater_, false)) applied_ = 0;
  Q_EMIT changed();
  return hasBegun;
}

void ExactTouch::keep() {
  if (!isApplied() && !apply()) return;
  if (leaving_ != 0)
    isKeptLater_ = true;
  else
    applied_ = 0;
  Q_EMIT changed();
}

bool ExactTouch::release() {
  if (!isApplied()) return false;
  if (leaving_ == 0) simulation_.end(applied_);
  applied_ = leaving_ = 0;
  Q_EMIT changed();
  return true;
}

void ExactTouch::store() {
  if (!isComplete() || !checkPlace()) return;
  modeling::Touch stored = touch();
  stored.name = freeName(tr("touch").toStdString(), workspace_.editor.project().touches);
  if (workspace_.editor.perform(modeling::AddTouch{stored}))
    Q_EMIT workspace_.editor.said(
        tr("Stored as \"%1\" in the project").arg(QString::fromStdString(stored.name)));
}

}  // namespace palpa::gui
