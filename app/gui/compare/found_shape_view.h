#pragma once

#include <QObject>

#include "app/gui/compare/variant_comparison.h"
#include "app/gui/document/shape_finder.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Draws the shape that a search has found as a ghost beside the present one, until it is accepted
/// or discarded. A comparison with another variant has the ghost first.
class FoundShapeView : public QObject {
  Q_OBJECT

 public:
  FoundShapeView(ShapeFinder& finder, VariantComparison& comparison, ViewportWidget& widget);

  bool isDrawn() const { return isDrawn_; }

 private:
  void update();
  void draw();

  ShapeFinder& finder_;
  VariantComparison& comparison_;
  ViewportWidget& widget_;
  bool isDrawn_ = false;
};

}  // namespace palpa::gui
