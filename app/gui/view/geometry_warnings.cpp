#include "app/gui/view/geometry_warnings.h"

namespace palpa::gui {
namespace {

using modeling::GeometryFault;

/// Text beside the sign; the Rebuild panel has the whole sentence.
QString shortText(GeometryFault fault) {
  switch (fault) {
    case GeometryFault::kSelfIntersection:
      return GeometryWarnings::tr("cuts through itself");
    case GeometryFault::kTouching:
      return GeometryWarnings::tr("touches itself");
    case GeometryFault::kInvertedTriangle:
      return GeometryWarnings::tr("points inwards");
    case GeometryFault::kZeroArea:
      return GeometryWarnings::tr("no area");
    case GeometryFault::kOpenEdge:
      return GeometryWarnings::tr("hole or gap");
    case GeometryFault::kWrongOrientation:
      return GeometryWarnings::tr("sides disagree");
    case GeometryFault::kInsideOut:
      return GeometryWarnings::tr("inside out");
    case GeometryFault::kFoldedPatch:
      return GeometryWarnings::tr("folded");
  }
  return {};
}

}  // namespace

GeometryWarnings::GeometryWarnings(Editor& editor, ViewportWidget& widget)
    : QObject(&widget), editor_(editor), widget_(widget) {
  connect(&editor, &Editor::rebuildChanged, this, &GeometryWarnings::show);
}

void GeometryWarnings::show() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  if (status.findings == shown_ && status.reason.conflict == conflict_) return;
  shown_ = status.findings;
  conflict_ = status.reason.conflict;
  std::vector<view::WarningMarker> markers;
  for (const modeling::GeometryFinding& finding : *shown_)
    markers.push_back({finding.at, shortText(finding.fault).toStdString()});
  if (conflict_)
    markers.push_back({conflict_->at, (conflict_->overlaps ? tr("“%1” and “%2” overlap")
                                                           : tr("“%1” and “%2” meet"))
                                          .arg(QString::fromStdString(conflict_->first),
                                               QString::fromStdString(conflict_->second))
                                          .toStdString()});
  widget_.viewport().setWarnings(markers);
  widget_.update();
}

}  // namespace palpa::gui
