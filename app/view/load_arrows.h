#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <vector>

#include "app/view/bounds.h"
#include "app/view/flat_shapes.h"
#include "app/view/turntable.h"
#include "app/view/viewport_scene.h"

/// Force arrows of the interactive view. Internal to app/view.
namespace palpa::view {

/// Solid arrows that shine faintly through the body, with labels beside their free ends.
class LoadArrows {
 public:
  LoadArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay);

  /// `bodyDiagonal` (mm) sets their size.
  void set(const std::vector<ForceArrow>& arrows, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  void setVisible(bool visible);
  /// Places the labels; to be called before drawing, between clear() and finish() of `shapes`.
  void update(const Turntable& camera, FlatShapes& shapes);

  /// Tails and tips.
  const std::vector<Eigen::Vector3d>& ends() const { return ends_; }

 private:
  struct Label {
    vtkSmartPointer<vtkTextActor> text;
    Eigen::Vector3d free, held;  ///< ends of the arrow
    Eigen::Vector2d size;        ///< pixels
    Colour frame;
  };

  void clear();

  vtkRenderer* scene_;
  vtkRenderer* shineThrough_;
  vtkRenderer* overlay_;
  std::vector<vtkSmartPointer<vtkActor>> solid_, faint_;
  std::vector<Label> labels_;
  std::vector<Eigen::Vector3d> ends_;
  Colour plate_{};
  bool visible_ = true;
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
