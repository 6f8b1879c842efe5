#pragma once

#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/gui/base/canvas.h"
#include "app/gui/view/pointer_event.h"
#include "app/gui/view/quick_resolution.h"
#include "app/gui/view/tool.h"
#include "app/view/viewport/viewport.h"

namespace palpa::gui {

/// Qt widget with a Viewport. Navigation as in common CAD programs (navigationHelp()); all other
/// events go to the tool.
class ViewportWidget : public QWidget {
  Q_OBJECT

 public:
  explicit ViewportWidget(QWidget* parent = nullptr);
  ~ViewportWidget() override;

  view::Viewport& viewport() { return *viewport_; }
  const view::Viewport& viewport() const { return *viewport_; }

  /// Mouse buttons that navigate, whatever tool is active.
  static KeyHelp navigationHelp();

  /// Tool that receives the events; not owned, null for none.
  void setTool(Tool* tool);

  /// Drawing time of the last frame, ms.
  double lastFrameMilliseconds() const { return lastFrame_; }

  /// Draws the view with this size in pixels and writes it as PNG. Throws ViewError.
  void writePicture(const std::filesystem::path& file, const QSize& size);

  /// Draws soon, in quick quality, during motion. A fine picture follows after the motion.
  void updateQuickly();

  /// While the rebuild needs the processor, pictures stay quick if fine ones take long.
  void setComputing(bool computing);

 Q_SIGNALS:
  void framePainted();
  /// The user pressed Escape and the tool had nothing to cancel.
  void escaped();
  /// The user pressed a key without modifiers that neither the tool nor a menu uses.
  void keyUnused(int key);

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
  /// Ends the navigation or operation of a button that is no longer pressed: a dialog that opened
  /// meanwhile received its release.
  void noticeReleases(const QMouseEvent& event);

  // The view cube. All return true if the event belongs to it.
  std::optional<view::ViewCubePart> cubePartAt(const QMouseEvent& event) const;
  bool pressCube(const QMouseEvent& event);
  bool moveOverCube(const QMouseEvent& event);
  void releaseCube(const QMouseEvent& event);
  void hoverCube(const std::optional<view::ViewCubePart>& part);

  /// Resizes the canvas to the widget, with this share of its pixels in each direction.
  void fitCanvas(double resolution = 1);

  Canvas canvas_;
  std::unique_ptr<view::Viewport> viewport_;
  Tool* tool_ = nullptr;
  Navigation navigation_ = Navigation::kNone;
  Qt::MouseButton navigating_ = Qt::NoButton, pressed_ = Qt::NoButton;  // the latter by the tool
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  double lastFrame_ = 0, lastFineFrame_ = 0;  // ms
  bool isMoving_ = false;                     // pictures are quick
  bool isReduced_ = false;                    // and may have fewer pixels: something moves
  QuickResolution resolution_;
  std::optional<view::ViewCubePart> hoveredCube_, pressedCube_;
  bool isComputing_ = false;
  bool isWarm_ = false;
  QTimer restTimer_;
};

}  // namespace palpa::gui
