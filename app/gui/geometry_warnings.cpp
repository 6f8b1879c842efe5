#include "app/gui/geometry_warnings.h"

namespace palpa::gui {

GeometryWarnings::GeometryWarnings(Editor& editor, ViewportWidget& widget)
    : QObject(&widget), editor_(editor), widget_(widget) {
  connect(&editor, &Editor::rebuildChanged, this, &GeometryWarnings::show);
}

void GeometryWarnings::show() {
  app::GeometryError::Findings findings = editor_.rebuildStatus().findings;
  if (findings == shown_) return;
  shown_ = std::move(findings);
  std::vector<view::WarningMarker> markers;
  for (const modeling::GeometryFinding& finding : *shown_)
    markers.push_back({finding.at, finding.message});
  widget_.viewport().setWarnings(markers);
  widget_.update();
}

}  // namespace palpa::gui
