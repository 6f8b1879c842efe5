#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "app/view/camera/bounds.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Another body beside the body. Internal to app/view.
namespace palpa::view {

/// A translucent surface in one colour, denser towards its rim, with its borders. The body hides
/// what lies inside it; there the borders are drawn faintly. Create it after the body.
class ComparedBody {
 public:
  ComparedBody(vtkRenderer* scene, vtkRenderer* shineThrough);
  /// Without positions nothing is drawn.
  void set(const ViewportBody& body);
  void move(const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& normals);
  std::size_t size() const { return size_; }
  void setPixelRatio(double ratio);
  const Bounds& bounds() const { return bounds_; }

 private:
  std::size_t size_ = 0;
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> normals_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkActor> actor_;
  std::array<vtkSmartPointer<vtkActor>, 2> borders_;  ///< visible, shining through
  Bounds bounds_;
};

}  // namespace palpa::view
