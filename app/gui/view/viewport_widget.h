#pragma once

#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <memory>

#include "app/gui/base/canvas.h"
#include "app/gui/view/pointer_event.h"
#include "app/gui/view/tool.h"
#include "app/view/viewport.h"

namespace palpa::gui {

/// The view in the window: a Viewport on a Qt widget. Navigation as in common CAD programs: middle
/// button or Alt + left orbits, Shift with it pans, the wheel zooms at the pointer; everything else
/// goes to the tool.
class ViewportWidget : public QWidget {
  Q_OBJECT

 public:
  explicit ViewportWidget(QWidget* parent = nullptr);
  ~ViewportWidget() override;

  view::Viewport& viewport() { return *viewport_; }

  /// The tool that gets the events; not owned, null for none.
  void setTool(Tool* tool);

  /// Milliseconds the last frame took to draw.
  double lastFrameMilliseconds() const { return lastFrame_; }

  /// Writes what is shown as PNG, drawn anew with this size in pixels. Throws ViewError.
  void writePicture(const std::filesystem::path& file, const QSize& size);

  /// Draws soon and quickly: something moves. A fine picture follows when nothing moves any more.
  void updateQuickly();

  /// While something else needs the processor, pictures stay quick where fine ones take long.
  void setComputing(bool computing);

 Q_SIGNALS:
  void framePainted();
  /// Escape was pressed and the tool had nothing to cancel.
  void escaped();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Navigation { kNone, kOrbit, kPan };
  PointerEvent pointerEvent(const QMouseEvent& event) const;
  Eigen::Vector2d toDevice(const QPointF& point) const;
  void navigate(const Eigen::Vector2d& pixel);
  /// Ends what a button began that is not held any more: a dialog that opened meanwhile has got its
  /// release.
  void noticeReleases(const QMouseEvent& event);

  /// Makes the canvas as large as the widget.
  void fitCanvas();

  Canvas canvas_;
  std::unique_ptr<view::Viewport> viewport_;
  Tool* tool_ = nullptr;
  Navigation navigation_ = Navigation::kNone;
  Qt::MouseButton navigating_ = Qt::NoButton, pressed_ = Qt::NoButton;  // the latter by the tool
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  double lastFrame_ = 0, lastFineFrame_ = 0;  // ms
  bool isMoving_ = false;
  bool isComputing_ = false;
  bool isWarm_ = false;
  QTimer restTimer_;
};

}  // namespace palpa::gui
