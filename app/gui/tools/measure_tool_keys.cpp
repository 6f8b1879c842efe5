#include "app/gui/tools/measure_tool.h"

// Keys and hints of MeasureTool.

namespace palpa::gui {
namespace {

using modeling::MeasurementKind;

bool isEnter(const QKeyEvent& event) {
  return event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
}

}  // namespace

bool MeasureTool::wantsKey(const QKeyEvent& event) const {
  return event.key() == Qt::Key_Tab || event.key() == Qt::Key_Backtab || isEnter(event) ||
         (event.key() == Qt::Key_Backspace && !places_.empty());
}

bool MeasureTool::key(QKeyEvent* event) {
  if (event->key() == Qt::Key_Tab || event->key() == Qt::Key_Backtab) {
    const auto count = static_cast<int>(modeling::kMeasurementKinds.size());
    const int step = event->key() == Qt::Key_Tab ? 1 : count - 1;
    setKind(static_cast<MeasurementKind>((static_cast<int>(kind_) + step) % count));
    return true;
  }
  if (event->key() == Qt::Key_Control) {
    isOther_ = true;
    hover();
    return false;
  }
  if (isEnter(*event)) {
    if (places_.empty()) measureSelection();
    return true;
  }
  if (event->key() == Qt::Key_Backspace && !places_.empty()) {
    places_.pop_back();
    hover();
    Q_EMIT changed();
    return true;
  }
  return false;
}

std::vector<KeyHelp::Row> MeasureTool::keyRows() const {
  return {{tr("Measure: next kind"), tr("Tab")},
          {tr("Measure: whole edges and faces instead of points, or points"), tr("Ctrl")},
          {tr("Measure: the selected patches or edges"), tr("Enter")},
          {tr("Measure: drop the last place; all"), tr("Backspace; Escape")}};
}

QString MeasureTool::hint() const {
  const QString next = " " + tr("(Tab: other kind)");
  switch (kind_) {
    case MeasurementKind::kLength:
      return tr("Length: click an edge") + next;
    case MeasurementKind::kThickness:
      return tr("Wall thickness: click a point of the surface") + next;
    case MeasurementKind::kRadius:
      return tr("Radius: click the surface or an edge") + next;
    case MeasurementKind::kAngle:
      if (takesWhole())
        return (places_.empty() ? tr("Angle: click the first face or edge")
                                : tr("Angle: click the second face or edge")) +
               next;
      return (places_.empty()       ? tr("Angle: click a point on the first arm")
              : places_.size() == 1 ? tr("Angle: click the corner")
                                    : tr("Angle: click a point on the second arm")) +
             next;
    case MeasurementKind::kDistance:
      break;
  }
  return (places_.empty() ? tr("Distance: click the first point; Ctrl takes a whole edge or face")
                          : tr("Distance: click the second point; Escape begins again")) +
         next;
}

}  // namespace palpa::gui
