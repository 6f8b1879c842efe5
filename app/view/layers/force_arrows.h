#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "app/view/arrow_labels.h"
#include "app/view/arrow_mesh.h"
#include "app/view/arrows.h"
#include "app/view/flat_shapes.h"
#include "app/view/text_pool.h"
#include "app/view/turntable.h"
#include "app/view/viewport_scene.h"

/// Force arrows of the interactive view. Internal to app/view.
namespace palpa::view {

/// Solid arrows that shine faintly through the body, with labels on plates beside their free ends.
/// All of it is kept and written anew: arrows may change for every picture.
class ForceArrows {
 public:
  ForceArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay);

  /// Loads: the largest force a sixth of `bodyDiagonal` (mm) long.
  void set(const std::vector<ForceArrow>& arrows, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  /// The largest a quarter of it.
  void set(const LiveArrows& arrows, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  void setVisible(bool visible);
  /// Places the labels where nothing of `taken` is, which they join; to be called before drawing,
  /// between clear() and finish() of `shapes`.
  void update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes);

  /// Tails and tips.
  const std::vector<Eigen::Vector3d>& ends() const { return ends_; }

 private:
  struct Label {
    Eigen::Vector3d free, held;  ///< ends of the arrow
    Colour frame;
    std::optional<int> choice{};  ///< of its place in the picture before
  };

  void show(const std::vector<PlacedArrow>& arrows, double bodyDiagonal, const ViewportTheme& theme,
            double pixelRatio);
  void updateVisibility();

  ArrowMesh mesh_;
  vtkSmartPointer<vtkActor> solid_, faint_;
  TextPool texts_;
  std::vector<Label> labels_;
  std::vector<Eigen::Vector3d> ends_;
  ViewportTheme theme_ = ViewportTheme::light();
  bool visible_ = true;
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
