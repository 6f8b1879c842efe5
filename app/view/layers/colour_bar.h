#pragma once

#include <optional>
#include <vector>

#include "app/view/arrow_labels.h"
#include "app/view/flat_shapes.h"
#include "app/view/text_pool.h"
#include "app/view/ticks.h"
#include "app/view/turntable.h"
#include "app/view/viewport_scene.h"

/// The legend of the field in the interactive view. Internal to app/view.
namespace palpa::view {

/// The colours with round numbers beside them, the field's name and unit above, on a plate at the
/// right edge. Pictures have their own (ScalarBar), which is drawn once.
class ColourBar {
 public:
  explicit ColourBar(vtkRenderer* overlay);

  /// The values are not looked at; the range must be there. None: no bar.
  void set(const std::optional<ScalarField>& field, const ViewportTheme& theme, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`; adds its place to
  /// `taken`.
  void update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes);
  /// How far it reaches from the right edge into a picture of that height, pixels: its colours with
  /// their numbers. The words above them may reach further.
  double reach(double pictureHeight);

 private:
  Ticks ticks(double pictureHeight) const;
  void drawColours(const Eigen::Vector2d& low, const Eigen::Vector2d& high, FlatShapes& shapes);

  TextPool titles_, numbers_;
  std::optional<ScalarField> field_;  ///< without values
  std::array<double, 2> range_{0, 1};
  std::vector<Colour> colours_;
  ScalarField::Colours coloursOf_ = ScalarField::Colours::kSequential;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
