#include "app/gui/tools/point_options.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::gui {
namespace {

constexpr double kMinFalloff = 1e-3;  // mm
constexpr double kMaxFalloff = 1e5;   // mm

}  // namespace

template <class Value>
void PointOptions::set(Value& member, Value value) {
  if (member == value) return;
  member = value;
  Q_EMIT changed();
}

void PointOptions::setPick(Pick pick) {
  set(pick_, pick);
}

void PointOptions::setHasFalloff(bool has) {
  set(hasFalloff_, has);
}

void PointOptions::setFalloff(double radius) {
  set(falloff_, std::clamp(radius, kMinFalloff, kMaxFalloff));
}

void PointOptions::setMirror(Mirror mirror) {
  set(mirror_, mirror);
}

void PointOptions::setSnaps(bool snaps) {
  set(snaps_, snaps);
}

modeling::Reach PointOptions::reach(const modeling::Solid& solid) const {
  modeling::Reach reach;
  if (hasFalloff_) reach.falloff = falloff_;
  if (mirror_ != Mirror::kOff) {
    const int number = static_cast<int>(mirror_) - 1;
    modeling::MirrorPlane plane;
    plane.normal = Eigen::Vector3d::Unit(number % 3);
    if (number >= 3) {
      const auto [low, high] = modeling::boundingBox(solid);
      plane.point = 0.5 * (low + high);
    }
    reach.mirror = plane;
  }
  return reach;
}

std::array<PointOptions::PickInfo, 3> PointOptions::pickInfos() {
  return {{{Pick::kPoints, "point", tr("Points"), tr("Pick &points"), Qt::ALT | Qt::Key_1,
            tr("Clicks and boxes select control points")},
           {Pick::kPatches, "patch", tr("Patches"), tr("Pick pa&tches"), Qt::ALT | Qt::Key_2,
            tr("Clicks and boxes select patches")},
           {Pick::kEdges, "edge", tr("Edges"), tr("Pick &edges"), Qt::ALT | Qt::Key_3,
            tr("Clicks and boxes select edges")}}};
}

QWidget* PointOptions::makeWidget(const Settings& settings, QWidget* parent) {
  auto* widget = new QWidget(parent);
  auto* form = new QFormLayout(widget);
  form->setContentsMargins(0, 0, 0, 0);

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(2);
  auto* group = new QButtonGroup(widget);
  for (const PickInfo& info : pickInfos()) {
    auto* button = new QToolButton(widget);
    button->setObjectName(info.icon);
    button->setIcon(icon(info.icon));
    button->setText(info.name);
    button->setToolTip(info.tip + " (" + info.key.toString(QKeySequence::NativeText) + ")");
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    group->addButton(button, static_cast<int>(info.pick));
    buttons->addWidget(button);
  }
  buttons->addStretch(1);
  auto* pickLabel = new QLabel(tr("Select"), widget);
  form->addRow(pickLabel, buttons);
  connect(group, &QButtonGroup::idClicked, this, [this](int id) { setPick(Pick(id)); });

  auto* falloffRow = new QHBoxLayout;
  auto* has = new QCheckBox(tr("&Falloff"), widget);
  has->setObjectName("falloff");
  has->setToolTip(
      tr("Points within this distance follow, less with distance; the wheel changes the radius "
         "while points move"));
  auto* radius = new QuantityEdit(Quantity::kLength, settings, widget);
  radius->setObjectName("falloffRadius");
  radius->setAccessibleName(tr("Falloff radius"));
  radius->setRange(kMinFalloff, kMaxFalloff);
  falloffRow->addWidget(radius);
  form->addRow(has, falloffRow);
  connect(has, &QCheckBox::toggled, this, &PointOptions::setHasFalloff);
  connect(radius, &QuantityEdit::edited, this, &PointOptions::setFalloff);

  auto* plane = new QComboBox(widget);
  plane->setObjectName("mirror");
  plane->addItems({tr("Off"), "x = 0", "y = 0", "z = 0", tr("Body's middle across x"),
                   tr("Body's middle across y"), tr("Body's middle across z")});
  plane->setToolTip(tr("Points at mirrored places move mirrored"));
  form->addRow(tr("&Mirror"), plane);
  connect(plane, &QComboBox::activated, this, [this](int item) { setMirror(Mirror(item)); });

  auto* snap = new QCheckBox(tr("Snap"), widget);
  snap->setObjectName("snap");
  snap->setToolTip(
      tr("The dragged point goes to the control point or edge under the pointer, or to the grid; "
         "angles and factors are rounded. Ctrl reverses it (F9)"));
  form->addRow(QString(), snap);
  connect(snap, &QCheckBox::toggled, this, &PointOptions::setSnaps);

  const auto show = [=, this] {
    snap->setChecked(snaps_);
    group->button(static_cast<int>(pick_))->setChecked(true);
    has->setChecked(hasFalloff_);
    radius->setEnabled(hasFalloff_);
    radius->setValue(falloff_);
    plane->setCurrentIndex(static_cast<int>(mirror_));
  };
  connect(this, &PointOptions::changed, widget, show);
  show();
  return widget;
}

}  // namespace palpa::gui
