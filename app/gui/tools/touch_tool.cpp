#include "app/gui/tools/touch_tool.h"

#include <Eigen/Geometry>
#include <QComboBox>

#include "app/gui/widgets/form_row.h"
#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {
namespace {

using Style = view::ToolDrawing::Style;

constexpr double kDepthShare = 0.05;  // of the body's size

}  // namespace

double TouchTool::depth() const {
  return depth_.value_or(kDepthShare * bodySize());
}

void TouchTool::setDepth(double depth) {
  depth_ = depth;
  Q_EMIT changed();
}

void TouchTool::setKind(modeling::TouchKind kind) {
  kind_ = kind;
  Q_EMIT changed();
}

bool TouchTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  place_ = scene_.placeAt(event.pixel);
  isDragged_ = false;
  pressed_ = last_ = event.pixel;
  if (place_) {
    vector_ = modeling::infoOf(kind_).needsVector ? Eigen::Vector3d(-depth() * place_->normal)
                                                  : Eigen::Vector3d::Zero();
    drawTouch(*place_, vector_);
  }
  return true;
}

bool TouchTool::move(const PointerEvent& event) {
  last_ = event.pixel;
  if (place_) {
    if (isDragged_ || (event.pixel - pressed_).norm() >= kDragThreshold)
      pull(event.pixel, alongNormal_ || (event.modifiers & Qt::ControlModifier) != 0);
    return true;
  }
  view::ToolDrawing drawing;
  if (const auto place = scene_.placeAt(event.pixel))
    drawing.dots.push_back({place->position, Style::kPreview});
  draw(drawing);
  return false;
}

void TouchTool::pull(const Eigen::Vector2d& pixel, bool alongNormal) {
  isDragged_ = true;
  const auto to = alongNormal
                      ? widget_.viewport().onLine(pixel, place_->position, place_->normal)
                      : std::optional(widget_.viewport().inViewPlane(pixel, place_->position));
  if (to && to->allFinite()) vector_ = *to - place_->position;
  drawTouch(*place_, vector_);
}

void TouchTool::drawTouch(const SurfacePlace& place, const Eigen::Vector3d& vector) {
  view::ToolDrawing drawing;
  const Eigen::Vector3d tip = place.position + vector;
  if (alongNormal_) {
    const Eigen::Vector3d reach = bodySize() * place.normal;
    drawing.lines.push_back(
        {{place.position - reach, place.position + reach}, Style::kGuide, false});
  }
  drawing.lines.push_back({{place.position, tip}, Style::kPreview, false});
  drawing.dots.push_back({place.position, Style::kSelected});
  drawing.dots.push_back({tip, Style::kPreview});
  drawing.labels.push_back({tip, shownLength(vector.norm()).toStdString()});
  draw(drawing);
}

bool TouchTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !place_) return false;
  const modeling::Touch touch{freeName(tr("touch").toStdString(), editor_.project().touches),
                              place_->position,
                              kind_,
                              vector_,
                              {},
                              modeling::infoOf(kind_).presses ? friction_ : 0.0};
  place_.reset();
  draw({});
  if (editor_.perform(modeling::AddTouch{touch}))
    editor_.select(Selection::of(Selection::Kind::kTouch, touch.name));
  return true;
}

bool TouchTool::wantsKey(const QKeyEvent& event) const {
  return place_ && event.key() == Qt::Key_N;
}

bool TouchTool::key(QKeyEvent* event) {
  if (!wantsKey(*event)) return false;
  alongNormal_ = !alongNormal_;
  if (isDragged_)
    pull(last_, alongNormal_);
  else
    drawTouch(*place_, vector_);
  Q_EMIT changed();
  return true;
}

bool TouchTool::cancel() {
  if (!place_) return false;
  place_.reset();
  hideHover();
  return true;
}

std::vector<KeyHelp::Row> TouchTool::keyRows() const {
  return {{tr("Touch along the normal"), tr("Ctrl, or N while dragging")}};
}

QString TouchTool::hint() const {
  return (alongNormal_ ? tr("Drag along the normal (N while dragging: parallel to the screen). ")
                       : tr("Drag parallel to the screen (Ctrl, or N while dragging: along the "
                            "normal). ")) +
         (kind_ == modeling::TouchKind::kPin
              ? tr("A click fixes the place")
              : tr("A click presses %1 inwards").arg(shownLength(depth())));
}

QWidget* TouchTool::makeOptions(QWidget* parent) {
  auto* options = new QWidget(parent);
  auto* form = new QFormLayout(options);
  form->setContentsMargins(0, 0, 0, 0);
  auto* kind = new QComboBox(options);
  // The drag draws a displacement.
  for (const modeling::TouchKindInfo& info : modeling::kTouchKinds)
    if (!info.isForce) kind->addItem(tr(info.label), static_cast<int>(info.kind));
  kind->setCurrentIndex(kind->findData(static_cast<int>(kind_)));
  addFormRow(form, tr("&Kind"), kind, "touchKind",
             tr("A grab moves the place; a fingertip and a ball press, but do not pull, and slide;"
                " a pin holds the place"));
  auto* friction = new QuantityEdit(Quantity::kNumber, settings_, options);
  friction->setRange(0, modeling::kMaxFriction);
  friction->setValue(friction_);
  addFormRow(form, tr("&Friction"), friction, "touchFriction",
             tr("Coulomb's coefficient of the fingertip or ball"));
  const auto enable = [this, friction] { friction->setEnabled(modeling::infoOf(kind_).presses); };
  enable();
  connect(kind, &QComboBox::activated, this, [this, kind, enable] {
    setKind(static_cast<modeling::TouchKind>(kind->currentData().toInt()));
    enable();
  });
  connect(friction, &QuantityEdit::edited, this, &TouchTool::setFriction);
  auto* depth = new QuantityEdit(Quantity::kLength, settings_, options);
  depth->setRange(1e-9, 1e9);
  depth->setValue(this->depth());
  addFormRow(form, tr("&Depth of a click"), depth, "touchDepth",
             tr("How far a click without a drag presses into the body"));
  connect(depth, &QuantityEdit::edited, this, &TouchTool::setDepth);
  connect(&editor_, &Editor::projectReplaced, depth,
          [this, depth] { depth->setValue(this->depth()); });
  return options;
}

}  // namespace palpa::gui
