#pragma once

#include <vtkRenderer.h>

#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Words around the body. Internal to app/view.
namespace palpa::view {

/// Title at the top left, caption lines at the bottom on the right of the axes, smaller where the
/// picture is too narrow for them.
class CaptionLayer {
 public:
  explicit CaptionLayer(vtkRenderer* overlay) : title_(overlay), lines_(overlay) {}

  /// `support`, `stroke`: colours of the hatching that the caption explains.
  void set(const Caption& caption, const ViewportTheme& theme, const Colour& support,
           const Colour& stroke, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`; adds its places to
  /// `taken`.
  void update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes);
  /// Pixels at the upper and lower edge of a picture of that width.
  Reserve reserve(double pictureWidth);

 private:
  /// Sets the texts for a picture of that width.
  void setTexts(double pictureWidth);
  double lineHeight() const;

  TextPool title_, lines_;
  Caption caption_;
  ViewportTheme theme_ = ViewportTheme::light();
  Colour support_{}, stroke_{};
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
