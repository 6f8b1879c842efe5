#include "app/gui/compare/found_shape_view.h"

#include "modeling/solid/tessellation.h"

namespace palpa::gui {
namespace {

constexpr int kPause = 200;  // ms

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
  pause_.setSingleShot(true);
  pause_.setInterval(kPause);
  connect(&pause_, &QTimer::timeout, this, &FoundShapeView::update);
  connect(&finder, &ShapeFinder::changed, this, &FoundShapeView::update);
  connect(&comparison, &VariantComparison::changed, this, &FoundShapeView::update);
  // At the end of a comparison ComparisonView, which hears it first, removes every ghost.
  connect(&comparison, &VariantComparison::compared, this, [this] {
    if (drawn_ && !comparison_.isActive()) draw();
  });
}

std::shared_ptr<const modeling::Solid> FoundShapeView::wanted() const {
  if (comparison_.isActive()) return nullptr;
  const auto& steps = finder_.steps();
  switch (finder_.state()) {
    case ShapeFinder::State::kFound:
      // Does not own the solid: the finder keeps its result as long as it is in this state.
      return {std::shared_ptr<void>(), &std::get<modeling::Solid>(finder_.result().project.body)};
    case ShapeFinder::State::kSearching:
      // The first one is the present shape.
      for (std::size_t k = steps.size(); k > 1; --k)
        if (steps[k - 1].isAccepted) return steps[k - 1].solid;
      return nullptr;
    case ShapeFinder::State::kIdle:
    case ShapeFinder::State::kStopping:
      return nullptr;
  }
  return nullptr;
}

void FoundShapeView::update() {
  const auto shape = wanted();
  if (shape == drawn_) return;
  const bool isSearching = finder_.state() == ShapeFinder::State::kSearching;
  if (shape && isSearching && pause_.isActive()) return;
  drawn_ = shape;
  if (drawn_) {
    if (isSearching) pause_.start();
    draw();
    return;
  }
  widget_.viewport().setCompared(std::nullopt);
  widget_.viewport().setCaption({});
  widget_.update();
}

void FoundShapeView::draw() {
  view::Viewport& viewport = widget_.viewport();
  viewport.setCompared(ghostOf(*drawn_));
  view::Caption caption;
  caption.compared =
      (finder_.state() == ShapeFinder::State::kSearching ? tr("Present shape of the search")
                                                         : tr("Found shape, not accepted yet"))
          .toStdString();
  viewport.setCaption(caption);
  widget_.update();
}

}  // namespace palpa::gui
