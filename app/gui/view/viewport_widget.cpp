#include "app/gui/view/viewport_widget.h"

#include <QElapsedTimer>
#include <QPainter>
#include <cmath>
#include <utility>

namespace palpa::gui {
namespace {

constexpr int kRestAfterComputing = 500;  // ms
constexpr int kRest = 150;                // ms without movement until a fine picture is drawn
constexpr double kLongFrame = 20;         // ms; fine pictures take longer with software OpenGL

}  // namespace

ViewportWidget::ViewportWidget(QWidget* parent) : QWidget(parent) {
  viewport_ = std::make_unique<view::Viewport>(canvas_.window(), devicePixelRatioF());
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(320, 240);
  setAttribute(Qt::WA_OpaquePaintEvent);
  restTimer_.setSingleShot(true);
  connect(&restTimer_, &QTimer::timeout, this, [this] {
    isMoving_ = isReduced_ = false;
    update();
  });
}

ViewportWidget::~ViewportWidget() {
  canvas_.makeCurrent();
  viewport_.reset();
}

KeyHelp ViewportWidget::navigationHelp() {
  return {tr("Navigation"),
          {{tr("Orbit"), tr("Middle button, or Alt + left button")},
           {tr("Pan"), tr("Right button, Shift + middle button")},
           {tr("Zoom at the pointer"), tr("Wheel")},
           {tr("Look at a side, an edge or a corner; a quarter turn"),
            tr("Click on the view cube; its arrows")},
           {tr("Cancel the operation, or clear the selection"), tr("Escape")}}};
}

void ViewportWidget::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool ? tool->cursor() : QCursor(Qt::ArrowCursor));
}

void ViewportWidget::updateQuickly() {
  isMoving_ = isReduced_ = true;
  restTimer_.start(kRest);
  update();
}

void ViewportWidget::setComputing(bool computing) {
  if (computing == isComputing_) return;
  isComputing_ = computing;
  if (computing || lastFineFrame_ <= kLongFrame) return;
  // Panels show the result first, and the worker still estimates the condition number.
  isMoving_ = true;
  restTimer_.start(kRestAfterComputing);
}

void ViewportWidget::fitCanvas(double resolution) {
  const double ratio = devicePixelRatioF();
  const QSize size(static_cast<int>(std::lround(width() * ratio * resolution)),
                   static_cast<int>(std::lround(height() * ratio * resolution)));
  if (canvas_.size() == size && viewport_->pixelRatio() == ratio &&
      viewport_->resolution() == resolution)
    return;
  canvas_.resize(size);
  viewport_->setResolution(resolution);
  viewport_->setPixelRatio(ratio);
}

void ViewportWidget::resizeEvent(QResizeEvent*) {
  fitCanvas();
}

void ViewportWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!canvas_.isValid()) {
    painter.fillRect(rect(), palette().window());
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The solid cannot be drawn: this display offers no OpenGL 3.2. Install "
                        "a graphics driver, or Mesa, which draws without one."));
    return;
  }
  QElapsedTimer timer;
  timer.start();
  const double resolution = isReduced_ ? resolution_.share() : 1;
  fitCanvas(resolution);  // another screen may have another pixel ratio
  canvas_.makeCurrent();
  if (!std::exchange(isWarm_, true)) viewport_->warmUp();
  const bool isQuick = isMoving_ || (isComputing_ && lastFineFrame_ > kLongFrame);
  viewport_->render(isReduced_ ? view::Quality::kMoving
                    : isQuick  ? view::Quality::kQuick
                               : view::Quality::kFine);
  QImage image = canvas_.image();
  if (resolution == 1) {
    image.setDevicePixelRatio(devicePixelRatioF());
    painter.drawImage(0, 0, image);
  } else {
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(rect(), image);
  }
  lastFrame_ = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  if (!isQuick) lastFineFrame_ = lastFrame_;
  if (isReduced_) resolution_.drawn(lastFrame_);
  Q_EMIT framePainted();
}

void ViewportWidget::writePicture(const std::filesystem::path& file, const QSize& size) {
  canvas_.makeCurrent();
  // Lines, handles and text grow with the picture.
  viewport_->setResolution(1);
  viewport_->setPixelRatio(static_cast<double>(size.height()) / std::max(1, height()));
  canvas_.resize(size);
  const bool hasCube = viewport_->isViewCubeVisible();
  viewport_->setViewCubeVisible(false);
  const auto restore = [this, hasCube] {
    viewport_->setViewCubeVisible(hasCube);
    fitCanvas();
    update();
  };
  try {
    viewport_->writePng(file);
  } catch (...) {
    restore();
    throw;
  }
  restore();
}

}  // namespace palpa::gui
