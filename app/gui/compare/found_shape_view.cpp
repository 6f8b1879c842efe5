#include "app/gui/compare/found_shape_view.h"

#include "modeling/solid/tessellation.h"

namespace palpa::gui {
namespace {

view::ViewportBody ghostOf(const modeling::Solid& solid) {
  const modeling::Tessellation tessellation(solid);
  modeling::Tessellation::Shape shape = tessellation.evaluate(solid.controlPoints());
  return {std::move(shape.positions),     std::move(shape.normals), tessellation.triangles(),
          tessellation.patchOfTriangle(), tessellation.borders(),   {}};
}

}  // namespace

FoundShapeView::FoundShapeView(ShapeFinder& finder, VariantComparison& comparison,
                               ViewportWidget& widget)
    : QObject(&widget), finder_(finder), comparison_(comparison), widget_(widget) {
  connect(&finder, &ShapeFinder::changed, this, &FoundShapeView::update);
  connect(&comparison, &VariantComparison::changed, this, &FoundShapeView::update);
  // At the end of a comparison ComparisonView, which hears it first, removes every ghost.
  connect(&comparison, &VariantComparison::compared, this, [this] {
    if (isDrawn_ && !comparison_.isActive()) draw();
  });
}

void FoundShapeView::update() {
  const bool isWanted = finder_.state() == ShapeFinder::State::kFound && !comparison_.isActive();
  if (isWanted == isDrawn_) return;
  isDrawn_ = isWanted;
  if (isWanted) {
    draw();
    return;
  }
  widget_.viewport().setCompared(std::nullopt);
  widget_.viewport().setCaption({});
  widget_.update();
}

void FoundShapeView::draw() {
  view::Viewport& viewport = widget_.viewport();
  viewport.setCompared(ghostOf(std::get<modeling::Solid>(finder_.result().project.body)));
  view::Caption caption;
  caption.compared = tr("Found shape, not accepted yet").toStdString();
  viewport.setCaption(caption);
  widget_.update();
}

}  // namespace palpa::gui
