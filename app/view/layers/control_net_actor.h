#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// The control net. Internal to app/view.
namespace palpa::view {

/// Net lines and round handles, drawn twice: in the scene, and faintly in a renderer in front of it
/// so that hidden handles shimmer through the body.
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
