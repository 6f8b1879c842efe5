#pragma once

#include <QObject>

#include "app/gui/document/editor.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Shows the findings of the last geometry check, and the place where supports contradict each
/// other, as signs in the view.
class GeometryWarnings : public QObject {
  Q_OBJECT

 public:
  GeometryWarnings(Editor& editor, ViewportWidget& widget);

 private:
  void show();

  Editor& editor_;
  ViewportWidget& widget_;
  app::GeometryError::Findings shown_;
  std::optional<app::SupportConflict> conflict_;
};

}  // namespace palpa::gui
