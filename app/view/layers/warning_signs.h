#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Warnings at places of the body. Internal to app/view.
namespace palpa::view {

/// A triangular sign above each place with its text beside it, in front of everything. Signs that
/// would cover each other move up.
class WarningSigns {
 public:
  explicit WarningSigns(vtkRenderer* overlay);

  void set(const std::vector<WarningMarker>& warnings, const ViewportTheme& theme,
           double pixelRatio);
  void setVisible(bool visible) { visible_ = visible; }
  /// To be called before drawing, between clear() and finish() of `shapes`.
  void update(const Turntable& camera, FlatShapes& shapes);

 private:
  struct Sign {
    Eigen::Vector3d at;
    vtkSmartPointer<vtkTextActor> text;
    Eigen::Vector2d size;  ///< of the text, pixels
  };

  void draw(const Sign& sign, const Eigen::Vector2d& place, const Eigen::Vector2d& low,
            const Eigen::Vector2d& high, bool textOnTheLeft, const Turntable& camera,
            FlatShapes& shapes);

  vtkRenderer* overlay_;
  std::vector<Sign> signs_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
  bool visible_ = true;
};

}  // namespace palpa::view
