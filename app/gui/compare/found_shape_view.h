#pragma once

#include <QObject>
#include <QTimer>
#include <memory>

#include "app/gui/compare/variant_comparison.h"
#include "app/gui/document/shape_finder.h"
#include "app/gui/view/viewport_widget.h"
#include "modeling/solid/solid.h"

namespace palpa::gui {

/// Draws the newest shape that a search has kept as a ghost beside the present one while it
/// searches, at most five times per second, and the found one until it is accepted or discarded. A
/// comparison with another variant has the ghost first.
class FoundShapeView : public QObject {
  Q_OBJECT

 public:
  FoundShapeView(ShapeFinder& finder, VariantComparison& comparison, ViewportWidget& widget);

  bool isDrawn() const { return drawn_ != nullptr; }
  /// The drawn shape; none: no ghost.
  const modeling::Solid* drawn() const { return drawn_.get(); }

 private:
  void update();
  std::shared_ptr<const modeling::Solid> wanted() const;
  void draw();

  ShapeFinder& finder_;
  VariantComparison& comparison_;
  ViewportWidget& widget_;
  std::shared_ptr<const modeling::Solid> drawn_;
  QTimer pause_;  // between two drawings of a search
};

}  // namespace palpa::gui
