#include "app/gui/simulate/simulate_tool.h"

#include <Eigen/Geometry>
#include <QKeyEvent>
#include <utility>

namespace palpa::gui {
namespace {

using Kind = bem::ContactTool::Kind;
using Style = view::ToolDrawing::Style;

constexpr double kNotch = 0.05;   // of the radius, per notch of the wheel
constexpr double kPinReach = 12;  // pixels

/// Drawn mm per mm of displacement; 1 if displacements are not drawn, so that drags keep their
/// effect.
double drawnScale(const Simulation& simulation) {
  return simulation.scale() > 0 ? simulation.scale() : 1;
}

/// N per mm of drag for a force: about the stiffness of a half-space under a disc, so that drag and
/// displacement look alike.
double forcePerLength(const app::DrawnBody& body, double radius) {
  return 2 * body.model().setup().material.youngsModulus * radius;
}

}  // namespace

SimulateTool::SimulateTool(Kind kind, Settings& settings, Simulation& simulation,
                           SimulateOptions& options, ViewportWidget& widget)
    : kind_(kind),
      settings_(settings),
      simulation_(simulation),
      options_(options),
      widget_(widget) {
  connect(&simulation, &Simulation::activeChanged, this, [this] {
    drag_.reset();
    Q_EMIT changed();
  });
  connect(&simulation, &Simulation::bodyChanged, this, &Tool::changed);
  connect(&simulation, &Simulation::waitingChanged, this, &Tool::changed);
  connect(&simulation, &Simulation::framed, this, [this] {
    const int pins = simulation_.snapshot().contactCount;
    if (std::exchange(pins_, pins) != pins) Q_EMIT changed();
  });
}

std::optional<SurfacePick> SimulateTool::placeAt(const Eigen::Vector2d& pixel) const {
  return pickSurface(simulation_, widget_, pixel);
}

std::optional<app::TouchId> SimulateTool::pinAt(const Eigen::Vector2d& pixel) const {
  if (!simulation_.drawn()) return std::nullopt;
  std::optional<app::TouchId> nearest;
  double least = kPinReach * widget_.devicePixelRatioF();
  for (const auto& contact : simulation_.snapshot().touched()) {
    if (simulation_.hasEnded(contact.id)) continue;
    const Eigen::Vector3d drawn =
        contact.point.position + simulation_.scale() * simulation_.displacementAt(contact.point);
    const double distance = (widget_.viewport().toPixel(drawn) - pixel).norm();
    if (distance > least) continue;
    least = distance;
    nearest = contact.id;
  }
  return nearest;
}

bool SimulateTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  widget_.viewport().setToolDrawing({});
  if (const auto pin = pinAt(event.pixel)) {
    const auto& contact = *simulation_.snapshot().find(*pin);
    const Eigen::Vector3d drawn =
        contact.point.position + simulation_.scale() * simulation_.displacementAt(contact.point);
    const bem::BoundaryMesh& mesh = simulation_.drawn()->model().setup().mesh();
    const double gain = contact.tool.kind == Kind::kForce
                            ? forcePerLength(*simulation_.drawn(), contact.tool.radius)
                            : 1;
    drag_ = Drag{*pin,
                 contact.tool.kind,
                 gain,
                 drawnScale(simulation_),
                 contact.value,
                 drawn,
                 mesh.normal(contact.point.triangle),
                 event.pixel,
                 Eigen::Vector3d::Zero(),
                 Eigen::Vector3d::Zero()};
    Q_EMIT changed();
    return true;
  }
  const auto place = placeAt(event.pixel);
  if (!place) return true;
  const double radius = options_.radius(*simulation_.drawn());
  bem::ContactTool tool{kind_, radius};
  if (tool.presses()) tool.friction = options_.friction();
  // Begin without a jump: at the present place, in contact, or without force.
  const Eigen::Vector3d displaced =
      simulation_.displacementAt(simulation_.body()->surface().tree().nearest(place->at));
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  switch (kind_) {
    case Kind::kForce:
      break;
    case Kind::kGrab:
      start = displaced;
      break;
    case Kind::kPush:
      start = place->at + displaced;
      break;
    case Kind::kBall:
      start = place->at + displaced + radius * place->normal;
  }
  const auto id = simulation_.begin(tool, place->at, start);
  if (!id) return true;
  drag_ = Drag{*id,
               kind_,
               kind_ == Kind::kForce ? forcePerLength(*simulation_.drawn(), radius) : 1,
               drawnScale(simulation_),
               start,
               place->drawn,
               place->normal,
               event.pixel,
               Eigen::Vector3d::Zero(),
               Eigen::Vector3d::Zero()};
  widget_.setCursor(cursor());
  Q_EMIT changed();
  return true;
}

void SimulateTool::pull(const Eigen::Vector2d& pixel, bool alongNormal) {
  if (alongNormal != drag_->alongNormal) {
    drag_->alongNormal = alongNormal;
    drag_->done = drag_->motion;
    drag_->from = pixel;
  }
  const view::Viewport& viewport = widget_.viewport();
  const Eigen::Vector3d place = drag_->place + drag_->done;
  const auto at = [&](const Eigen::Vector2d& where) {
    return alongNormal ? viewport.onLine(where, place, drag_->normal)
                       : std::optional(viewport.inViewPlane(where, place));
  };
  const auto before = at(drag_->from), now = at(pixel);
  if (!before || !now || !now->allFinite()) return;
  drag_->motion = drag_->done + (*now - *before);
  follow();
}

void SimulateTool::follow() {
  // Motions are measured in the picture, where displacements are scaled but places on the surface
  // are not. So pushing contacts follow the pointer along the surface, and only their motion into
  // the surface is divided by the scale.
  Eigen::Vector3d moved = drag_->motion / drag_->scale;
  if (bem::ContactTool{drag_->kind}.presses()) {
    const Eigen::Vector3d inwards = drag_->normal * drag_->normal.dot(drag_->motion);
    moved = drag_->motion - inwards + inwards / drag_->scale;
  }
  simulation_.move(drag_->id, drag_->start + drag_->gain * moved);
}

bool SimulateTool::move(const PointerEvent& event) {
  pointer_ = event.pixel;
  if (!drag_) {
    drawHover(event.pixel);
    return false;
  }
  pull(event.pixel, (event.modifiers & Qt::ControlModifier) != 0);
  return true;
}

void SimulateTool::drawHover(const Eigen::Vector2d& pixel) {
  view::ToolDrawing drawing;
  if (const auto place = placeAt(pixel)) {
    drawing.dots.push_back({place->drawn, pinAt(pixel) ? Style::kHovered : Style::kPreview});
    simulation_.expect(place->at);
  }
  widget_.viewport().setToolDrawing(drawing);
  widget_.update();
}

bool SimulateTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !drag_) return false;
  const bool stays = (event.modifiers & Qt::ShiftModifier) != 0;
  if (!stays) simulation_.end(drag_->id);
  drag_.reset();
  widget_.setCursor(cursor());
  Q_EMIT changed();
  return true;
}

bool SimulateTool::doubleClick(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  if (const auto pin = pinAt(event.pixel)) {
    simulation_.end(*pin);
    return true;
  }
  return press(event);
}

bool SimulateTool::wheel(const PointerEvent&, double notches) {
  if (!drag_ || !simulation_.drawn()) return false;
  const Eigen::Vector3d step =
      -notches * kNotch * options_.radius(*simulation_.drawn()) * drag_->scale * drag_->normal;
  drag_->done += step;
  drag_->motion += step;
  follow();
  return true;
}

void SimulateTool::leave() {
  if (drag_) return;
  widget_.viewport().setToolDrawing({});
  widget_.update();
}

bool SimulateTool::wantsKey(const QKeyEvent& event) const {
  return event.key() == Qt::Key_Delete || event.key() == Qt::Key_Backspace;
}

bool SimulateTool::key(QKeyEvent* event) {
  if (!wantsKey(*event)) return false;
  const auto pin = drag_ ? std::nullopt : pinAt(pointer_);
  if (pin) simulation_.end(*pin);
  return true;
}

bool SimulateTool::cancel() {
  if (drag_) {
    simulation_.end(drag_->id);
    drag_.reset();
    widget_.setCursor(cursor());
    Q_EMIT changed();
    return true;
  }
  if (!simulation_.isActive() || simulation_.snapshot().contactCount == 0) return false;
  simulation_.endAll();
  return true;
}

void SimulateTool::deactivate() {
  if (drag_) cancel();
  widget_.viewport().setToolDrawing({});
}

QCursor SimulateTool::cursor() const {
  return drag_ ? Qt::ClosedHandCursor : Qt::OpenHandCursor;
}

QString SimulateTool::hint() const {
  if (drag_)
    return tr("Ctrl or the wheel: along the normal. Shift while releasing: stays as a pin");
  if (!simulation_.drawn()) return simulation_.waitingHint();
  if (pins_ > 0)
    return tr("Drag a pin to move it; double-click or Delete removes it; Escape removes all pins");
  switch (kind_) {
    case Kind::kGrab:
      return tr("Drag the surface: it follows the pointer");
    case Kind::kPush:
      return tr("Press on the surface, push in with the wheel or Ctrl, drag to slide");
    case Kind::kBall:
      return tr("Press on the surface to set a ball on it, push in with the wheel or Ctrl");
    case Kind::kForce:
      return tr("Press on the surface and drag: the longer the drag, the larger the force");
  }
  return {};
}

KeyHelp SimulateTool::keyHelp() const {
  return {tr("Simulate"),
          {{tr("Touch"), tr("Left button")},
           {tr("Along the normal"), tr("Ctrl, or wheel")},
           {tr("Leave a pin"), tr("Shift while releasing the button")},
           {tr("Move a pin"), tr("Left button on it")},
           {tr("Remove a pin; all pins"), tr("Double click or Delete; Escape")}}};
}

QWidget* SimulateTool::makeOptions(QWidget* parent) {
  return options_.makeFields(kind_, settings_, simulation_, parent);
}

}  // namespace palpa::gui
