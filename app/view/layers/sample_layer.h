#pragma once

#include <vtkRenderer.h>

#include <functional>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Numbers at points of the body. Internal to app/view.
namespace palpa::view {

/// Plates with lines to their points, placed beside the points so that they cover neither each
/// other nor anything else in the overlay, as far as there is room.
class SampleLayer {
 public:
  explicit SampleLayer(vtkRenderer* overlay) : texts_(overlay) {}

  void set(const std::vector<SampleLabel>& labels, const ViewportTheme& theme, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`, after everything else
  /// has entered its boxes into `taken`; `hidden` tells whether the body lies before a point.
  void update(const Turntable& camera, const std::function<bool(const Eigen::Vector3d&)>& hidden,
              std::vector<PixelBox>& taken, FlatShapes& shapes);

 private:
  void drawPoint(const Eigen::Vector2d& pixel, SampleLabel::Kind kind, double opacity,
                 FlatShapes& shapes) const;
  Colour colourOf(SampleLabel::Kind kind) const;

  TextPool texts_;
  std::vector<SampleLabel> labels_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
