#include "app/gui/simulate/mouse_3d_control.h"

#include <Eigen/Geometry>
#include <QApplication>
#include <cmath>

#include "app/gui/base/settings.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

// Of the fully deflected cap, per second.
constexpr double kTurn = 300;       // logical pixels of an orbit: 2 rad
constexpr double kPan = 0.8;        // heights of the view
constexpr double kZoom = 1.5;       // logarithm of the factor
constexpr double kPinMotion = 1.5;  // radii of the tool

}  // namespace

Mouse3dControl::Mouse3dControl(const Workspace& workspace, Simulation& simulation, QObject* parent)
    : QObject(parent), workspace_(workspace), simulation_(simulation), mouse_(this) {
  Settings& settings = workspace.settings;
  workspace.menus.addToggle(workspace.menus.view,
                            {nullptr,
                             tr("3-&D mouse"),
                             {},
                             tr("A 3-D mouse (spacenavd) moves the view, and the newest pin")},
                            settings.usesMouse3d(), this, [this, &settings](bool on) {
                              settings.setUsesMouse3d(on);
                              mouse_.setActive(on);
                            });
  connect(&mouse_, &Mouse3d::moved, this, &Mouse3dControl::move);
  connect(&mouse_, &Mouse3d::pressed, this, &Mouse3dControl::press);
  if (settings.usesMouse3d()) mouse_.setActive(true);
}

void Mouse3dControl::move(const Mouse3d::Motion& motion) {
  // The daemon tells all programs.
  if (!workspace_.window.isActiveWindow()) return;
  ViewportWidget& widget = workspace_.view;
  view::Viewport& viewport = widget.viewport();
  const double ratio = widget.devicePixelRatioF();
  const Vector2d size = ratio * Vector2d(widget.width(), widget.height());
  viewport.orbit(kTurn * ratio * Vector2d(motion.turn.y(), motion.turn.x()));
  if (!movePin(motion.push)) {
    viewport.pan(kPan * size.y() * Vector2d(motion.push.x(), -motion.push.y()));
    viewport.zoom(std::exp(kZoom * motion.push.z()), 0.5 * size);
  }
  widget.updateQuickly();
}

/// False without a pin.
bool Mouse3dControl::movePin(const Vector3d& push) {
  if (!simulation_.isActive() || !simulation_.drawn()) return false;
  const app::TouchSnapshot::Contact* newest = nullptr;
  for (const auto& contact : simulation_.snapshot().touched())
    if (simulation_.isOwn(contact.id)) newest = &contact;
  if (!newest) {
    pin_.reset();
    return false;
  }
  // A dragged pin follows the pointer.
  const bool isDragged = (QApplication::mouseButtons() & Qt::LeftButton) != 0;
  if (isDragged || !pin_ || pin_->id != newest->id) pin_ = Pin{newest->id, newest->value};
  if (isDragged) return true;
  const view::CameraView camera = workspace_.view.viewport().camera();
  const Vector3d right = camera.direction.cross(camera.up).normalized();
  const Vector3d moved = newest->tool.radius * kPinMotion *
                         (push.x() * right + push.y() * camera.up - push.z() * camera.direction);
  const double gain =
      newest->tool.kind == Kind::kForce
          ? 2 * simulation_.drawn()->model().setup().material.youngsModulus * newest->tool.radius
          : 1;
  pin_->value += gain * moved;
  simulation_.move(pin_->id, pin_->value);
  return true;
}

void Mouse3dControl::press(int button) {
  if (!workspace_.window.isActiveWindow()) return;
  if (button == 0) {
    workspace_.view.viewport().fit();
    workspace_.view.update();
  } else if (button == 1) {
    workspace_.tools.restart();
    if (simulation_.isActive()) simulation_.endAll();
  }
}

}  // namespace palpa::gui
