#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/arrow_mesh.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/scene/arrows.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Force arrows. Internal to app/view.
namespace palpa::view {

/// Solid arrows that shine faintly through the body, weights fully, with labels on plates beside
/// their free ends.
/// The actors are kept: arrows may change for every picture. Arrows that would leave the picture
/// are drawn shorter, and all are smaller where the camera is near.
class ForceArrows {
 public:
  ForceArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay);

  /// Loads: the largest force a sixth of `bodyDiagonal` (mm) long, the others at least a quarter of
  /// this length.
  void set(const std::vector<ForceArrow>& arrows, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  /// The full force kFullArrowLength · `bodyDiagonal` long.
  void set(const LiveArrows& arrows, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  /// Gradients: the largest kFullGradientLength · `bodyDiagonal` long; thin, and translucent if
  /// outdated.
  void set(const GradientDrawing& gradient, double bodyDiagonal, const ViewportTheme& theme,
           double pixelRatio);
  void setVisible(bool visible);
  /// Places the labels beside the boxes of `taken` and adds their own; to be called before drawing,
  /// between clear() and finish() of `shapes`.
  void update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes);

  /// Tails and tips, and points of the curved arrows.
  const std::vector<Eigen::Vector3d>& ends() const { return ends_; }

 private:
  struct Label {
    Eigen::Vector3d free, held;  ///< ends of the arrow, also where it is drawn shorter
    Colour frame;
    std::optional<int> choice{};  ///< of its place in the picture before
    bool isHeldAtTip = false;
    ForceArrow::Kind kind = ForceArrow::Kind::kForce;
    double share = 0;  ///< of the arrow that is drawn; 0: not yet

    Eigen::Vector3d shownFree() const { return held + share * (free - held); }
  };

  void show(const LiveArrows& arrows, double longest, double bodyDiagonal,
            const ViewportTheme& theme, double pixelRatio);
  /// Adds points of the curved arrow to `ends_`.
  void addTurn(const PlacedArrow& placed);
  void updateVisibility();
  /// Makes the arrows again that the view of the camera cuts off or shows too large.
  void fitToView(const Turntable& camera);

  ArrowMesh mesh_, weights_;
  vtkSmartPointer<vtkActor> solid_, faint_, strong_;
  TextPool texts_;
  std::vector<Label> labels_;
  std::vector<Eigen::Vector3d> ends_;
  ViewportTheme theme_ = ViewportTheme::light();
  double bodyDiagonal_ = 1;
  double slimness_ = 1;   ///< thickness over the thickness of force arrows
  double thickness_ = 1;  ///< diagonal that suits the thickness of the drawn arrows
  bool visible_ = true;
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
