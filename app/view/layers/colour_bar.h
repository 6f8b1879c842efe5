#pragma once

#include <optional>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"
#include "app/view/scene/ticks.h"

/// The legend of the field. Internal to app/view.
namespace palpa::view {

/// The colours with round numbers beside them, the field's name and unit above, its extremes below,
/// on plates at the right edge.
class ColourBar {
 public:
  explicit ColourBar(vtkRenderer* overlay);

  /// The values are ignored; the range is required. None: no bar.
  void set(const std::optional<ScalarField>& field, const ViewportTheme& theme, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`; adds its place to
  /// `taken`. `caption`: pixels above and below that words need.
  void update(const Turntable& camera, const Reserve& caption, std::vector<PixelBox>& taken,
              FlatShapes& shapes);
  /// Pixels from the right edge to the left end of the colours with their numbers, in a picture of
  /// that height; `withWords`: of the words above and below too, which may reach further.
  double reach(double pictureHeight, const Reserve& caption, bool withWords);

 private:
  /// Sets the texts for a bar of that height.
  Ticks setTexts(double height);
  /// Of the colours, in a picture of that height.
  double barHeight(double pictureHeight, const Reserve& caption) const;
  void drawColours(const Eigen::Vector2d& low, const Eigen::Vector2d& high, FlatShapes& shapes);

  TextPool titles_, numbers_, extremes_;
  std::optional<ScalarField> field_;  ///< without values
  std::array<double, 2> range_{0, 1};
  std::vector<Colour> colours_;
  ScalarField::Colours coloursOf_ = ScalarField::Colours::kSequential;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
