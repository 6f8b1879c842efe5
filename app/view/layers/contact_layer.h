#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

#include "app/view/camera/bounds.h"
#include "app/view/camera/turntable.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"

/// Contacts. Internal to app/view.
namespace palpa::view {

/// Rings on the surface, with a dark border against any colour below, faint where the body hides
/// them.
class ContactRings {
 public:
  ContactRings(vtkRenderer* scene, vtkRenderer* shineThrough);

  void set(const std::vector<ContactRing>& rings);
  void setPixelRatio(double ratio);
  const Bounds& bounds() const { return bounds_; }

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkUnsignedCharArray> colours_;  ///< one per dash
  vtkSmartPointer<vtkPolyData> lines_;
  vtkSmartPointer<vtkActor> border_, core_, faint_;
  Bounds bounds_;
};

/// Translucent balls, clear in the middle, so that the contact behind is visible, and dense at the
/// rim. Only near sides are drawn, the balls farther away first.
class Balls {
 public:
  explicit Balls(vtkRenderer* scene);

  void set(const std::vector<Ball>& balls);
  /// To be called before drawing.
  void update(const Turntable& camera);
  const Bounds& bounds() const { return bounds_; }
  const std::vector<Ball>& balls() const { return balls_; }

 private:
  void add();

  vtkRenderer* scene_;
  vtkSmartPointer<vtkPolyData> unitSphere_;
  std::vector<Ball> balls_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;  ///< drawn in this order; kept when not needed
  Bounds bounds_;
};

}  // namespace palpa::view
