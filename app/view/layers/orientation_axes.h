#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>

#include "app/view/camera/turntable.h"
#include "app/view/layers/flat_shapes.h"

/// The axes in the corner. Internal to app/view.
namespace palpa::view {

/// Three axes with letters in the lower left corner that turn with the camera.
class OrientationAxes {
 public:
  /// Side of the square in the corner that they need, logical pixels.
  static constexpr double kSide = 104;

  explicit OrientationAxes(vtkRenderer* overlay);

  void setVisible(bool visible);
  /// Once at least; the overlay must belong to a window by then.
  void setPixelRatio(double ratio);
  /// To be called before drawing, between clear() and finish() of `shapes`.
  void update(const Turntable& camera, FlatShapes& shapes);

 private:
  std::array<vtkSmartPointer<vtkTextActor>, 3> letters_;
  std::array<Eigen::Vector2d, 3> sizes_;
  vtkRenderer* overlay_;
  bool visible_ = true;
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
