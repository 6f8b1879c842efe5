#include "app/gui/dialogs/profile_canvas.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using modeling::ProfileSketch;
using modeling::SketchPointKind;

constexpr double kReach = 9.0;       // pixels within which points are picked and snapped to
constexpr double kGridPixels = 9.0;  // at least between two lines
constexpr double kMinScale = 1e-4, kMaxScale = 1e6;
constexpr double kMargin = 0.14;  // of the widget around the fitted curve

}  // namespace

ProfileCanvas::ProfileCanvas(SketchEditor& editor, const Settings& settings, QWidget* parent)
    : QWidget(parent), editor_(editor), settings_(settings) {
  setObjectName("canvas");
  setAccessibleName(tr("Profile"));
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(360, 300);
  setAttribute(Qt::WA_OpaquePaintEvent);
  connect(&editor_, &SketchEditor::changed, this, [this] { update(); });
  connect(&editor_, &SketchEditor::selectionChanged, this, [this] { update(); });
  connect(&settings_, &Settings::changed, this, [this] { update(); });
}

QPointF ProfileCanvas::pixelOf(const Vector2d& at) const {
  return {0.5 * width() + scale_ * (at.x() - centre_.x()),
          0.5 * height() - scale_ * (at.y() - centre_.y())};
}

Vector2d ProfileCanvas::placeOf(const QPointF& pixel) const {
  return {centre_.x() + (pixel.x() - 0.5 * width()) / scale_,
          centre_.y() - (pixel.y() - 0.5 * height()) / scale_};
}

double ProfileCanvas::reach() const {
  return kReach / scale_;
}

double ProfileCanvas::gridStep() const {
  return modeling::gridStep(kGridPixels / scale_, settings_.units().of(Quantity::kLength).factor);
}

void ProfileCanvas::fit() {
  Vector2d low = Vector2d::Zero(), high = Vector2d::Zero();
  bool any = false;
  for (const modeling::SketchSection& section : editor_.sections()) {
    if (section.profile.pointCount() == 0) continue;
    const auto [boxLow, boxHigh] = section.profile.box();
    low = any ? Vector2d(low.cwiseMin(boxLow)) : boxLow;
    high = any ? Vector2d(high.cwiseMax(boxHigh)) : boxHigh;
    any = true;
  }
  if (!any || (high - low).maxCoeff() <= 0.0) {
    low = high = Vector2d::Zero();
    high = low + Vector2d(40.0, 40.0);
    if (editor_.use() != modeling::SketchUse::kRevolve) low = -high;
  }
  if (editor_.use() == modeling::SketchUse::kRevolve) low.x() = std::min(low.x(), 0.0);
  centre_ = 0.5 * (low + high);
  const Vector2d extent = (high - low).cwiseMax(1e-3 * (high - low).maxCoeff());
  scale_ = (1.0 - 2.0 * kMargin) * std::min(width() / extent.x(), height() / extent.y());
  scale_ = std::clamp(scale_, kMinScale, kMaxScale);
  update();
}

void ProfileCanvas::resizeEvent(QResizeEvent* /*event*/) {
  if (isFitted_ || width() < 2 || height() < 2) return;
  fit();
  isFitted_ = isVisible();
}

void ProfileCanvas::setMode(Mode mode) {
  cancelDrag();
  target_.reset();
  if (mode_ != mode) {
    mode_ = mode;
    setCursor(mode == Mode::kDraw ? Qt::CrossCursor : Qt::ArrowCursor);
    Q_EMIT modeChanged();
  }
  update();
}

void ProfileCanvas::setSnap(bool toGrid, bool toPoints) {
  snapsToGrid_ = toGrid;
  snapsToPoints_ = toPoints;
}

modeling::Snapped ProfileCanvas::snappedPlace(const QPointF& pixel, const std::vector<int>& without,
                                              Qt::KeyboardModifiers modifiers) const {
  modeling::SnapRules rules;
  rules.reach = reach();
  const bool isFree = (modifiers & Qt::AltModifier) != 0;
  rules.toAxes = snapsToPoints_ && !isFree;
  if (snapsToGrid_ && !isFree) rules.gridStep = gridStep();
  if (snapsToPoints_ && !isFree) {
    const ProfileSketch& sketch = editor_.sketch();
    for (int i = 0; i < sketch.pointCount(); ++i)
      if (std::find(without.begin(), without.end(), i) == without.end())
        rules.points.push_back(sketch.points()[i].at);
  }
  return modeling::snapped(placeOf(pixel), rules);
}

void ProfileCanvas::zoom(double factor, const QPointF& about) {
  const Vector2d fixed = placeOf(about);
  scale_ = std::clamp(scale_ * factor, kMinScale, kMaxScale);
  centre_ += fixed - placeOf(about);
  update();
}

void ProfileCanvas::wheelEvent(QWheelEvent* event) {
  zoom(std::pow(1.0015, event->angleDelta().y()), event->position());
  event->accept();
}

void ProfileCanvas::mousePressEvent(QMouseEvent* event) {
  if (drag_ != Drag::kNone) return;
  pressed_ = event->position();
  if (event->button() == Qt::MiddleButton || event->button() == Qt::RightButton) {
    drag_ = Drag::kPan;
    centreAtPress_ = centre_;
    setCursor(Qt::ClosedHandCursor);
  } else if (event->button() == Qt::LeftButton) {
    if (mode_ == Mode::kDraw)
      pressDraw(event);
    else
      pressSelect(event);
  }
}

void ProfileCanvas::pressSelect(QMouseEvent* event) {
  const int point = modeling::nearestSketchPoint(editor_.sketch(), placeOf(pressed_), reach());
  const bool adds = (event->modifiers() & Qt::ShiftModifier) != 0;
  selectionAtPress_ = editor_.selection();
  if (point < 0) {
    drag_ = Drag::kBox;
    if (!adds) editor_.select({});
    return;
  }
  std::vector<int> selection = editor_.selection();
  if (adds && editor_.isSelected(point)) {
    std::erase(selection, point);
    editor_.select(selection);
    return;
  }
  if (adds)
    selection.push_back(point);
  else if (!editor_.isSelected(point))
    selection = {point};
  editor_.select(selection);
  drag_ = Drag::kPoints;
  draggedPoint_ = point;
  hasMoved_ = false;
  sketchAtPress_ = editor_.sketch();
}

void ProfileCanvas::pressDraw(QMouseEvent* event) {
  const ProfileSketch& sketch = editor_.sketch();
  // The first point of an open curve closes it.
  const bool canClose = !sketch.isClosed() && sketch.pointCount() >= 3;
  if (canClose && (placeOf(pressed_) - sketch.points().front().at).norm() <= reach()) {
    editor_.edit(tr("Close"), [](ProfileSketch& edited) { edited.close(); });
    setMode(Mode::kSelect);
    return;
  }
  const Vector2d at = snappedPlace(pressed_, {}, event->modifiers()).at;
  if (!sketch.isClosed() && sketch.pointCount() > 0 && sketch.points().back().at == at) return;
  const bool corner = drawsCorners_ != ((event->modifiers() & Qt::ShiftModifier) != 0);
  editor_.edit(sketch.isClosed() ? tr("Draw") : tr("Add point"), [&](ProfileSketch& edited) {
    if (edited.isClosed()) edited = {};
    edited.append(at, corner ? SketchPointKind::kCorner : SketchPointKind::kControl);
  });
  editor_.select({editor_.sketch().pointCount() - 1});
}

void ProfileCanvas::mouseMoveEvent(QMouseEvent* event) {
  pointer_ = event->position();
  const Vector2d place = placeOf(event->position());
  switch (drag_) {
    case Drag::kPan:
      centre_ = centreAtPress_ - Vector2d(event->position().x() - pressed_.x(),
                                          pressed_.y() - event->position().y()) /
                                     scale_;
      break;
    case Drag::kPoints:
      movePoints(event->position(), event->modifiers());
      break;
    case Drag::kBox:
    case Drag::kNone:
      hovered_ = modeling::nearestSketchPoint(editor_.sketch(), place, reach());
      break;
  }
  Vector2d shownPlace = place;
  target_.reset();
  if (mode_ == Mode::kDraw && drag_ == Drag::kNone) {
    target_ = snappedPlace(event->position(), {}, event->modifiers());
    shownPlace = target_->at;
  }
  if (drag_ == Drag::kPoints && draggedPoint_ < editor_.sketch().pointCount())
    shownPlace = editor_.sketch().points()[draggedPoint_].at;
  pointerText_ = tr("%1, %2").arg(shown(shownPlace.x(), Quantity::kLength, settings_.units(), 5),
                                  shown(shownPlace.y(), Quantity::kLength, settings_.units(), 5));
  Q_EMIT pointed();
  update();
}

void ProfileCanvas::movePoints(const QPointF& to, Qt::KeyboardModifiers modifiers) {
  if (!hasMoved_ && (to - pressed_).manhattanLength() < 4) return;
  // The pressed point snaps; the others keep their distance from it.
  std::vector<int> moving = editor_.selection();
  const Vector2d start = sketchAtPress_.points()[draggedPoint_].at;
  const QPointF offset = to - pressed_;
  const Vector2d target = snappedPlace(pixelOf(start) + offset, moving, modifiers).at;
  ProfileSketch moved = sketchAtPress_;
  moved.move(moving, target - start);
  if (!hasMoved_ && moved == sketchAtPress_) return;
  editor_.edit(
      tr("Move points"), [&](ProfileSketch& edited) { edited = moved; }, hasMoved_);
  hasMoved_ = true;
}

void ProfileCanvas::mouseReleaseEvent(QMouseEvent* event) {
  pointer_ = event->position();
  if (drag_ == Drag::kBox) {
    std::vector<int> selection =
        (event->modifiers() & Qt::ShiftModifier) != 0 ? selectionAtPress_ : std::vector<int>{};
    const QRectF box = QRectF(pressed_, event->position()).normalized();
    const ProfileSketch& sketch = editor_.sketch();
    for (int i = 0; i < sketch.pointCount(); ++i)
      if (box.contains(pixelOf(sketch.points()[i].at))) selection.push_back(i);
    editor_.select(selection);
  }
  endDrag();
}

void ProfileCanvas::endDrag() {
  if (drag_ == Drag::kPan) setCursor(mode_ == Mode::kDraw ? Qt::CrossCursor : Qt::ArrowCursor);
  drag_ = Drag::kNone;
  hasMoved_ = false;
  update();
}

void ProfileCanvas::cancelDrag() {
  if (drag_ == Drag::kPoints && hasMoved_) editor_.drop();
  if (drag_ == Drag::kPan) centre_ = centreAtPress_;
  endDrag();
}

void ProfileCanvas::focusOutEvent(QFocusEvent* event) {
  // A dialog over this one swallows the release of the button.
  if (drag_ == Drag::kPoints) endDrag();
  QWidget::focusOutEvent(event);
}

void ProfileCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (mode_ == Mode::kDraw) {
    // The first click placed the last point.
    setMode(Mode::kSelect);
    return;
  }
  const int point =
      modeling::nearestSketchPoint(editor_.sketch(), placeOf(event->position()), reach());
  if (point < 0)
    insertAt(event->position());
  else
    editor_.toggleCorners();
}

void ProfileCanvas::insertAt(const QPointF& pixel) {
  const auto place =
      modeling::nearestSketchPlace(editor_.sketch().samples(), placeOf(pixel), reach());
  if (!place) return;
  int inserted = -1;
  editor_.edit(tr("Insert points"),
               [&](ProfileSketch& edited) { inserted = edited.insert(*place); });
  editor_.select({inserted});
}

void ProfileCanvas::leaveEvent(QEvent* /*event*/) {
  pointer_.reset();
  target_.reset();
  hovered_ = -1;
  pointerText_.clear();
  Q_EMIT pointed();
  update();
}

}  // namespace palpa::gui
