#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// A shape drawn as a veil. Internal to app/view.
namespace palpa::view {

/// Translucent surface in one colour, denser towards its rim, which shows the outline of the shape
/// without computing it. Only the side that faces the eye is drawn.
class RimSurface {
 public:
  struct Look {
    const char* opacity;  ///< fragment shader code after "//VTK::Light::Impl" sets opacity
    const char* depth;    ///< vertex shader code, which changes gl_Position.z
    double ambient, diffuse;
  };

  RimSurface(vtkRenderer* scene, const Look& look);
  /// Without triangles nothing is drawn.
  void set(const ViewportBody& body);
  void move(const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& normals);
  void setColour(const Colour& colour);
  /// Positions of the surface, for lines on it.
  const vtkSmartPointer<vtkPoints>& points() const { return points_; }

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> normals_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace palpa::view
