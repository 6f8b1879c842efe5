#include "app/gui/tools/knot_tool.h"

#include <QComboBox>
#include <algorithm>
#include <cmath>

#include "app/gui/widgets/form_row.h"
#include "modeling/solid/isoparametric_line.h"

namespace palpa::gui {
namespace {

/// Middle of the span around a parameter.
double spanMiddle(const std::vector<double>& knots, double parameter) {
  const auto above = std::upper_bound(knots.begin(), knots.end(), parameter);
  const auto high =
      above == knots.end() ? std::lower_bound(knots.begin(), knots.end(), knots.back()) : above;
  return 0.5 * (*(high - 1) + *high);
}

/// Rounds a parameter to about a thousandth of the range, the precision of the pointer.
double rounded(double parameter, const std::array<double, 2>& range) {
  const double step = std::pow(10.0, std::floor(std::log10((range[1] - range[0]) / 999.0)));
  return std::round(parameter / step) * step;
}

}  // namespace

std::optional<KnotTool::Knot> KnotTool::knotAt(const Eigen::Vector2d& pixel,
                                               Qt::KeyboardModifiers modifiers) const {
  const auto place = scene_.placeAt(pixel);
  if (!place || !place->parameters) return std::nullopt;
  const bool isTurned = (modifiers & Qt::ShiftModifier) != 0;
  const int direction = isTurned ? 1 - direction_ : direction_;
  const modeling::Patch& patch = editor_.solid()->patches()[place->patch];
  const double under = (*place->parameters)[direction];
  const double parameter = (modifiers & Qt::ControlModifier) != 0
                               ? spanMiddle(patch.knots[direction], under)
                               : rounded(under, patch.range(direction));
  return Knot{{place->patch, direction}, parameter, place->position};
}

void KnotTool::hover() {
  view::ToolDrawing drawing;
  if (const auto knot = last_ ? knotAt(*last_, modifiers_) : std::nullopt) {
    for (auto& line : modeling::knotLinesOf(*editor_.solid(), knot->at, knot->parameter))
      drawing.lines.push_back({std::move(line), view::ToolDrawing::Style::kPreview, true});
    drawing.labels.push_back(
        {knot->place, tr("%1 = %2 on patch %3")
                          .arg(knot->at.direction == 0 ? "u" : "v")
                          .arg(knot->parameter, 0, 'g', 4)
                          .arg(QString::fromStdString(patchName(knot->at.patch)))
                          .toStdString()});
  }
  draw(drawing);
}

bool KnotTool::move(const PointerEvent& event) {
  last_ = event.pixel;
  modifiers_ = event.modifiers;
  hover();
  return false;
}

void KnotTool::leave() {
  last_.reset();
  hideHover();
}

bool KnotTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  if (!editor_.solid()) {
    Q_EMIT editor_.said(tr("A mesh body has no knots. Only solids made of patches have."));
    return true;
  }
  if (const auto knot = knotAt(event.pixel, event.modifiers)) {
    editor_.perform(
        modeling::InsertKnot{patchName(knot->at.patch), knot->at.direction, knot->parameter, 1});
    last_ = event.pixel;
    modifiers_ = event.modifiers;
    hover();
  }
  return true;
}

bool KnotTool::wantsKey(const QKeyEvent& event) const {
  return event.key() == Qt::Key_Tab;
}

bool KnotTool::key(QKeyEvent* event) {
  if (event->key() == Qt::Key_Tab) {
    setDirection(1 - direction_);
    return true;
  }
  if (event->key() == Qt::Key_Shift || event->key() == Qt::Key_Control) {
    modifiers_ |= event->key() == Qt::Key_Shift ? Qt::ShiftModifier : Qt::ControlModifier;
    hover();
  }
  return false;
}

void KnotTool::setDirection(int direction) {
  if (direction == direction_) return;
  direction_ = direction;
  hover();
  Q_EMIT changed();
}

std::vector<KeyHelp::Row> KnotTool::keyRows() const {
  return {{tr("Knot: other direction; middle of the span"), tr("Tab, or Shift; Ctrl")}};
}

QString KnotTool::hint() const {
  return tr("Click to insert a line of constant %1; Tab changes to %2, Ctrl takes the middle "
            "between two knots")
      .arg(direction_ == 0 ? "u" : "v", direction_ == 0 ? "v" : "u");
}

QWidget* KnotTool::makeOptions(QWidget* parent) {
  auto* options = new QWidget(parent);
  auto* form = new QFormLayout(options);
  form->setContentsMargins(0, 0, 0, 0);
  auto* direction = new QComboBox(options);
  direction->addItems({tr("Constant u"), tr("Constant v")});
  direction->setCurrentIndex(direction_);
  addFormRow(form, tr("&Line"), direction, "knotDirection", tr("Which line is inserted (Tab)"));
  connect(direction, &QComboBox::activated, this, &KnotTool::setDirection);
  connect(this, &Tool::changed, direction,
          [this, direction] { direction->setCurrentIndex(direction_); });
  return options;
}

}  // namespace palpa::gui
