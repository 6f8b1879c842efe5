#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include "app/view/viewport_geometry.h"
#include "app/view/viewport_scene.h"

/// The control net of the interactive view. Internal to app/view.
namespace palpa::view {

/// Net lines and round handles, drawn twice: in the scene, and faintly in a renderer in front of it
/// so that what the body hides shimmers through.
class ControlNetActor {
 public:
  ControlNetActor(vtkRenderer* scene, vtkRenderer* shineThrough);

  void setNet(const ControlNet& net);
  void movePoints(const std::vector<Eigen::Vector3d>& points);
  /// One per control point.
  void setStates(const std::vector<HandleState>& states);
  void setVisible(bool visible);
  void setTheme(const ViewportTheme& theme);
  void setPixelRatio(double ratio);

 private:
  /// The handles of one state.
  struct Handles {
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkActor> shown, hidden;
  };

  void updateLooks();

  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkActor> lines_, hiddenLines_;
  std::array<Handles, 4> handles_;  ///< by state
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
