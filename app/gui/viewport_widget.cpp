#include "app/gui/viewport_widget.h"

#include <vtkCallbackCommand.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <QElapsedTimer>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <cmath>

namespace palpa::gui {
namespace {

constexpr int kRest = 150;  // ms without movement until a fine picture is drawn

}  // namespace

void setDefaultSurfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setRedBufferSize(8);
  format.setGreenBufferSize(8);
  format.setBlueBufferSize(8);
  format.setAlphaBufferSize(0);  // with alpha the desktop would shine through the background
  format.setOption(QSurfaceFormat::DeprecatedFunctions);  // wide lines in Mesa
  format.setSwapInterval(0);
  QSurfaceFormat::setDefaultFormat(format);
}

ViewportWidget::ViewportWidget(QWidget* parent) : QOpenGLWidget(parent) {
  viewport_ = std::make_unique<view::Viewport>(window_, devicePixelRatioF());
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(320, 240);
  // What is removed from the scene outside of paintGL frees its buffers in the right context.
  vtkNew<vtkCallbackCommand> makeCurrent;
  makeCurrent->SetClientData(this);
  makeCurrent->SetCallback([](vtkObject*, unsigned long, void* widget, void*) {
    auto* self = static_cast<ViewportWidget*>(widget);
    if (self->context() && QOpenGLContext::currentContext() != self->context()) self->makeCurrent();
  });
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, makeCurrent);
  restTimer_.setSingleShot(true);
  restTimer_.setInterval(kRest);
  connect(&restTimer_, &QTimer::timeout, this, [this] {
    isMoving_ = false;
    update();
  });
}

ViewportWidget::~ViewportWidget() {
  if (context()) disconnect(context(), nullptr, this, nullptr);
  makeCurrent();
  viewport_.reset();
  window_->Finalize();
  window_->RemoveAllObservers();
  doneCurrent();
}

void ViewportWidget::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool ? tool->cursor() : QCursor(Qt::ArrowCursor));
}

void ViewportWidget::initializeGL() {
  // In another window the widget gets another context, and what lies in this one must go with it.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    window_->Finalize();
    window_->SetReadyForRendering(false);
  });
  window_->SetIsCurrent(true);
  window_->SetOwnContext(0);
  window_->OpenGLInitContext();
  window_->SetReadyForRendering(true);
  window_->SetFrameBlitModeToBlitToCurrent();
}

void ViewportWidget::resizeGL(int width, int height) {
  viewport_->setPixelRatio(devicePixelRatioF());
  const double ratio = devicePixelRatioF();
  window_->SetSize(static_cast<int>(std::lround(width * ratio)),
                   static_cast<int>(std::lround(height * ratio)));
}

void ViewportWidget::updateQuickly() {
  isMoving_ = true;
  restTimer_.start();
  update();
}

void ViewportWidget::paintGL() {
  QElapsedTimer timer;
  timer.start();
  window_->GetState()->Reset();
  window_->GetState()->Push();
  window_->GetState()->vtkglBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
  viewport_->render(isMoving_ ? view::Quality::kQuick : view::Quality::kFine);
  window_->GetState()->Pop();
  lastFrame_ = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  Q_EMIT framePainted();
}

void ViewportWidget::writePicture(const std::filesystem::path& file, const QSize& size) {
  makeCurrent();
  // Lines, handles and letters grow with the picture.
  viewport_->setPixelRatio(static_cast<double>(size.height()) / std::max(1, height()));
  window_->SetFrameBlitModeToNoBlit();
  window_->SetSize(size.width(), size.height());
  const auto restore = [this] {
    window_->SetFrameBlitModeToBlitToCurrent();
    resizeGL(width(), height());
    doneCurrent();
    update();
  };
  try {
    window_->GetState()->Reset();
    window_->GetState()->Push();
    viewport_->writePng(file);
    window_->GetState()->Pop();
  } catch (...) {
    window_->GetState()->Pop();
    restore();
    throw;
  }
  restore();
}

Eigen::Vector2d ViewportWidget::toDevice(const QPointF& point) const {
  return Eigen::Vector2d(point.x(), point.y()) * devicePixelRatioF();
}

PointerEvent ViewportWidget::pointerEvent(const QMouseEvent& event) const {
  return {toDevice(event.position()), event.button(), event.buttons(), event.modifiers()};
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  last_ = toDevice(event->position());
  if (event->button() == Qt::RightButton && tool_ && tool_->press(pointerEvent(*event))) return;
  const bool middle = event->button() == Qt::MiddleButton;
  const bool altLeft =
      event->button() == Qt::LeftButton && (event->modifiers() & Qt::AltModifier) != 0;
  if (middle || altLeft || event->button() == Qt::RightButton) {
    const bool pan =
        (event->modifiers() & Qt::ShiftModifier) != 0 || event->button() == Qt::RightButton;
    navigation_ = pan ? Navigation::kPan : Navigation::kOrbit;
    return;
  }
  if (tool_) tool_->press(pointerEvent(*event));
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
  if (navigation_ != Navigation::kNone) {
    navigate(toDevice(event->position()));
    return;
  }
  if (tool_) {
    tool_->move(pointerEvent(*event));
    setCursor(tool_->cursor());
  }
}

void ViewportWidget::navigate(const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d step = pixel - last_;
  if (navigation_ == Navigation::kOrbit)
    viewport_->orbit(step);
  else
    viewport_->pan(step, last_);
  last_ = pixel;
  updateQuickly();
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
  if (navigation_ != Navigation::kNone) {
    navigation_ = Navigation::kNone;
    return;
  }
  if (tool_) tool_->release(pointerEvent(*event));
}

void ViewportWidget::mouseDoubleClickEvent(QMouseEvent* event) {
  if (tool_) tool_->doubleClick(pointerEvent(*event));
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
  // Touchpads send parts of a notch.
  const double notches = event->angleDelta().y() / 120.0;
  if (notches == 0.0) return;
  const PointerEvent at{toDevice(event->position()), Qt::NoButton, event->buttons(),
                        event->modifiers()};
  if (tool_ && tool_->wheel(at, notches)) return;
  viewport_->zoom(std::pow(1.15, notches), toDevice(event->position()));
  updateQuickly();
  event->accept();
}

void ViewportWidget::leaveEvent(QEvent*) {
  if (tool_) tool_->leave();
}

void ViewportWidget::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    if (!tool_ || !tool_->cancel()) Q_EMIT escaped();
    return;
  }
  if (tool_ && tool_->key(event)) return;
  QOpenGLWidget::keyPressEvent(event);
}

bool ViewportWidget::event(QEvent* event) {
  // Keys that a tool takes must not reach the shortcuts of the menus first (x, y, z, digits while
  // a selection is dragged).
  if (event->type() == QEvent::ShortcutOverride && tool_) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Escape || tool_->wantsKey(*key)) {
      event->accept();
      return true;
    }
  }
  // Tab would otherwise move the focus before the tool sees it.
  if (event->type() == QEvent::KeyPress && tool_) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Tab && tool_->wantsKey(*key)) {
      keyPressEvent(key);
      return true;
    }
  }
  return QOpenGLWidget::event(event);
}

}  // namespace palpa::gui
