#pragma once

#include <vtkRenderer.h>

#include "app/view/rectangle.h"
#include "app/view/scene.h"

/// The legend of the colours. Internal to app/view.
namespace palpa::view {

/// A scalar bar laid out for one field: the colours with round numbers beside them, the field's
/// name and unit above, the data's extremes below.
class ScalarBar {
 public:
  /// `height` is that of the whole bar with its texts, in pixels; it is at most as tall as it needs
  /// to be readable. `fontSize` in pixels.
  ScalarBar(const ScalarField& field, double height, double fontSize, double pixel,
            vtkRenderer* overlay);

  double width() const { return width_; }

  /// Draws it with its upper left corner at `corner`.
  void draw(const Eigen::Vector2d& corner) const;

 private:
  const ScalarField& field_;
  double height_;
  double fontSize_;
  double pixel_;
  vtkRenderer* overlay_;
  std::string title_;
  std::string extremes_;
  double width_ = 0;
};

}  // namespace palpa::view
