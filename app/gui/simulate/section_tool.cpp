#include "app/gui/simulate/section_tool.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QKeyEvent>
#include <QPushButton>
#include <cmath>

#include "app/gui/widgets/form_row.h"
#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {
namespace {

using Style = view::ToolDrawing::Style;

constexpr double kArrow = 0.35;  // of the body's reach
constexpr double kNudge = 0.02;  // of the range of offsets

}  // namespace

SectionTool::SectionTool(Settings& settings, Simulation& simulation, SectionView& section,
                         ViewportWidget& widget)
    : settings_(settings), simulation_(simulation), section_(section), widget_(widget) {
  connect(&section, &SectionView::changed, this, [this] {
    if (isActive_) draw();
    Q_EMIT changed();
  });
  connect(&simulation, &Simulation::activeChanged, this, [this] { drag_.reset(); });
  connect(&simulation, &Simulation::bodyChanged, this, [this] {
    if (isActive_) draw();
    Q_EMIT changed();
  });
}

void SectionTool::activate() {
  isActive_ = true;
  section_.setShown(true);
  draw();
}

void SectionTool::deactivate() {
  isActive_ = false;
  cancel();
  widget_.viewport().setToolDrawing({});
  widget_.update();
}

void SectionTool::draw() {
  view::ToolDrawing drawing;
  if (section_.isShown() && simulation_.drawn()) {
    const modeling::Plane& plane = section_.plane();
    const Eigen::Vector3d middle = section_.middle();
    const double reach = section_.reach();
    const Eigen::Vector3d x = plane.normal.unitOrthogonal() * reach, y = plane.normal.cross(x);
    drawing.lines.push_back(
        {{middle - x - y, middle + x - y, middle + x + y, middle - x + y, middle - x - y},
         Style::kGuide,
         false});
    const Eigen::Vector3d tip = middle + kArrow * reach * plane.normal;
    const Style style = drag_ ? Style::kSelected : Style::kPreview;
    drawing.lines.push_back({{middle, tip}, style, false});
    drawing.dots.push_back({tip, style});
    drawing.dots.push_back({middle, style});
    drawing.labels.push_back(
        {tip, shown(plane.offset, Quantity::kLength, settings_.units(), 4).toStdString()});
  }
  widget_.viewport().setToolDrawing(drawing);
  widget_.update();
}

bool SectionTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !simulation_.drawn()) return false;
  section_.setShown(true);
  drag_ = Drag{section_.plane(), section_.middle(), event.pixel};
  draw();
  widget_.setCursor(cursor());
  return true;
}

bool SectionTool::move(const PointerEvent& event) {
  if (!drag_) return false;
  const view::Viewport& viewport = widget_.viewport();
  const Eigen::Vector3d& normal = drag_->before.normal;
  double by = 0;
  const auto from = viewport.onLine(drag_->from, drag_->through, normal),
             to = viewport.onLine(event.pixel, drag_->through, normal);
  // A normal along the view has no length on the screen: then the vertical path counts.
  const double lengthOnScreen =
      (viewport.toPixel(drag_->through + 0.1 * section_.reach() * normal) -
       viewport.toPixel(drag_->through))
          .norm();
  if (from && to && lengthOnScreen > 4) {
    by = normal.dot(*to - *from);
  } else {
    const Eigen::Vector3d a = viewport.inViewPlane(drag_->from, drag_->through),
                          b = viewport.inViewPlane(event.pixel, drag_->through);
    by = (event.pixel.y() < drag_->from.y() ? 1 : -1) * (b - a).norm();
  }
  if (!std::isfinite(by)) return true;
  section_.setPlane({normal, section_.rounded(drag_->before.offset + by)}, true);
  return true;
}

bool SectionTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !drag_) return false;
  drag_.reset();
  section_.setPlane(section_.plane());
  widget_.setCursor(cursor());
  return true;
}

bool SectionTool::cancel() {
  if (!drag_) return false;
  const modeling::Plane before = drag_->before;
  drag_.reset();
  section_.setPlane(before);
  widget_.setCursor(cursor());
  return true;
}

void SectionTool::choose(const Eigen::Vector3d& axis) {
  // The same axis again: the other side.
  section_.setShown(true);
  if (section_.plane().normal == axis)
    section_.flip();
  else
    section_.setNormal(axis);
}

void SectionTool::alongView() {
  section_.setShown(true);
  section_.setNormal(-widget_.viewport().camera().direction);
}

bool SectionTool::wantsKey(const QKeyEvent& event) const {
  switch (event.key()) {
    case Qt::Key_X:
    case Qt::Key_Y:
    case Qt::Key_Z:
    case Qt::Key_V:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      return !(event.modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    default:
      return false;
  }
}

bool SectionTool::key(QKeyEvent* event) {
  if (!wantsKey(*event)) return false;
  const auto nudge = [this](double sign) {
    const auto [least, most] = section_.offsets();
    modeling::Plane plane = section_.plane();
    plane.offset = section_.rounded(plane.offset + sign * kNudge * (most - least));
    section_.setPlane(plane);
  };
  switch (event->key()) {
    case Qt::Key_X:
      choose(Eigen::Vector3d::UnitX());
      break;
    case Qt::Key_Y:
      choose(Eigen::Vector3d::UnitY());
      break;
    case Qt::Key_Z:
      choose(Eigen::Vector3d::UnitZ());
      break;
    case Qt::Key_V:
      alongView();
      break;
    case Qt::Key_Up:
      nudge(1);
      break;
    case Qt::Key_Down:
      nudge(-1);
      break;
    default:
      drag_.reset();
      section_.setShown(false);
  }
  return true;
}

QCursor SectionTool::cursor() const {
  return drag_ ? Qt::ClosedHandCursor : Qt::OpenHandCursor;
}

QString SectionTool::hint() const {
  if (drag_) return tr("Drag along the normal; Escape puts the plane back");
  if (!simulation_.drawn()) return simulation_.waitingHint();
  return tr(
      "Drag to move the section; X, Y, Z, V: normal, the same key again takes the other side; "
      "arrows nudge; Delete removes it");
}

KeyHelp SectionTool::keyHelp() const {
  return {tr("Section plane"),
          {{tr("Move along the normal"), tr("Left button, Up, Down")},
           {tr("Normal along an axis; other side"), tr("X, Y, Z; again")},
           {tr("Normal towards the eye"), tr("V")},
           {tr("Remove"), tr("Delete")}}};
}

QWidget* SectionTool::makeOptions(QWidget* parent) {
  auto* fields = new QWidget(parent);
  auto* form = new QFormLayout(fields);
  form->setContentsMargins(0, 0, 0, 0);
  auto* isShown = new QCheckBox(tr("&Cut the body"), fields);
  isShown->setObjectName("sectionShown");
  form->addRow(isShown);
  auto* offset = new QuantityEdit(Quantity::kLength, settings_, fields);
  addFormRow(form, tr("&Offset"), offset, "sectionOffset",
             tr("Distance of the plane from the origin along the normal, on the unloaded body"));
  auto* normal = new VectorEdit(Quantity::kNumber, settings_, fields);
  addFormRow(form, tr("&Normal"), normal, "sectionNormal",
             tr("Points to the part of the body that is taken away"));
  auto* flip = new QPushButton(tr("O&ther side"), fields);
  flip->setObjectName("sectionFlip");
  form->addRow(flip);
  const auto show = [this, isShown, offset, normal] {
    const QSignalBlocker quiet(isShown);
    isShown->setChecked(section_.isShown());
    offset->setValue(section_.plane().offset);
    normal->setValue(section_.plane().normal);
  };
  show();
  connect(&section_, &SectionView::changed, fields, show);
  connect(isShown, &QCheckBox::toggled, this, [this](bool on) { section_.setShown(on); });
  connect(offset, &QuantityEdit::edited, this, [this](double value) {
    section_.setPlane({section_.plane().normal, value});
    Q_EMIT section_.changed();  // a limited offset is shown
  });
  connect(normal, &VectorEdit::edited, this, [this, show](const Eigen::Vector3d& value) {
    if (value.norm() > 0)
      section_.setNormal(value);
    else
      show();
  });
  connect(flip, &QPushButton::clicked, this, [this] { section_.flip(); });
  return fields;
}

}  // namespace palpa::gui
