#pragma once

#include <QObject>

#include "app/gui/document/editor.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Shows what the last geometry check found as signs at the places; they go when it is mended.
class GeometryWarnings : public QObject {
  Q_OBJECT

 public:
  GeometryWarnings(Editor& editor, ViewportWidget& widget);

 private:
  void show();

  Editor& editor_;
  ViewportWidget& widget_;
  app::GeometryError::Findings shown_;
};

}  // namespace palpa::gui
