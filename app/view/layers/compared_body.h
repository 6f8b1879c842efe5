#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>

#include "app/view/camera/bounds.h"
#include "app/view/layers/rim_surface.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Another body beside the body. Internal to app/view.
namespace palpa::view {

/// A translucent surface with its borders. The body hides the parts inside it; there the borders
/// are drawn faintly. Create it after the body.
class ComparedBody {
 public:
  ComparedBody(vtkRenderer* scene, vtkRenderer* shineThrough);
  /// Without positions nothing is drawn.
  void set(const ViewportBody& body);
  /// Moves the points, of which there are as many as before.
  void move(const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& normals);
  /// Number of points.
  std::size_t size() const { return size_; }
  void setPixelRatio(double ratio);
  const Bounds& bounds() const { return bounds_; }

 private:
  void findBounds(const std::vector<Eigen::Vector3d>& positions);

  std::size_t size_ = 0;
  RimSurface surface_;
  std::array<vtkSmartPointer<vtkActor>, 2> borders_;  ///< visible, shining through
  Bounds bounds_;
};

}  // namespace palpa::view
