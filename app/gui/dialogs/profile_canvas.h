#pragma once

#include <Eigen/Core>
#include <QWidget>
#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/dialogs/sketch_editor.h"
#include "modeling/shapes/sketch_picking.h"

namespace palpa::gui {

/// Plane with the curves of a SketchEditor: grid with numbers, points to click and drag, drawing.
/// Wheel: zoom at the pointer; middle or right button: pan.
class ProfileCanvas : public QWidget {
  Q_OBJECT

 public:
  enum class Mode { kSelect, kDraw };

  ProfileCanvas(SketchEditor& editor, const Settings& settings, QWidget* parent);

  Mode mode() const { return mode_; }
  void setMode(Mode mode);
  /// New points of Mode::kDraw are corners; Shift reverses it.
  void setDrawsCorners(bool corners) { drawsCorners_ = corners; }
  void setSnap(bool toGrid, bool toPoints);

  /// Shows the whole curve, and the axis of a revolved one.
  void fit();
  /// Step of the grid, mm: changes with the zoom.
  double gridStep() const;

  QPointF pixelOf(const Eigen::Vector2d& at) const;
  Eigen::Vector2d placeOf(const QPointF& pixel) const;
  /// The short text for the pointer: coordinates and what it snaps to.
  QString pointerText() const { return pointerText_; }

 Q_SIGNALS:
  void modeChanged();
  /// The pointer moved.
  void pointed();

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
  void focusOutEvent(QFocusEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Drag { kNone, kPoints, kBox, kPan };

  void pressSelect(QMouseEvent* event);
  void pressDraw(QMouseEvent* event);
  void movePoints(const QPointF& to, Qt::KeyboardModifiers modifiers);
  void endDrag();
  void cancelDrag();
  void insertAt(const QPointF& pixel);
  void zoom(double factor, const QPointF& about);
  void moveByKeys(QKeyEvent* event);
  /// Where a click or a dragged point lands; points in `without` do not attract.
  modeling::Snapped snappedPlace(const QPointF& pixel, const std::vector<int>& without,
                                 Qt::KeyboardModifiers modifiers) const;
  double reach() const;
  /// True while points are added: an open end is no error yet.
  bool isDrawn() const { return mode_ == Mode::kDraw && !editor_.sketch().isClosed(); }

  void drawGrid(QPainter& painter) const;
  void drawAxes(QPainter& painter) const;
  void drawOtherSections(QPainter& painter) const;
  void drawCurve(QPainter& painter) const;
  void drawPoints(QPainter& painter) const;
  void drawPending(QPainter& painter) const;
  void drawProblem(QPainter& painter) const;
  void drawRulers(QPainter& painter) const;
  QPolygonF polygonOf(const modeling::ProfileSketch& sketch) const;
  QString numberText(double value) const;

  SketchEditor& editor_;
  const Settings& settings_;
  Mode mode_ = Mode::kSelect;
  bool drawsCorners_ = false;
  bool snapsToGrid_ = true, snapsToPoints_ = true;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();  // mm, in the middle of the widget
  double scale_ = 5.0;                                // pixels per mm
  bool isFitted_ = false;

  Drag drag_ = Drag::kNone;
  QPointF pressed_;
  std::optional<QPointF> pointer_;
  std::optional<modeling::Snapped> target_;  // of the pointer in Mode::kDraw
  int draggedPoint_ = -1, hovered_ = -1;
  bool hasMoved_ = false;
  Eigen::Vector2d centreAtPress_;
  modeling::ProfileSketch sketchAtPress_;
  std::vector<int> selectionAtPress_;
  QString pointerText_;
};

}  // namespace palpa::gui
