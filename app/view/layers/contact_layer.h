#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

#include "app/view/bounds.h"
#include "app/view/turntable.h"
#include "app/view/viewport_geometry.h"
#include "app/view/viewport_scene.h"

/// Contacts in the interactive view. Internal to app/view.
namespace palpa::view {

/// Rings on the surface, with a dark border that parts them from any colour below, faint where the
/// body hides them.
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

/// Translucent balls, clear in the middle so that the contact behind can be seen, and dense at the
/// rim. Only near sides are drawn, the balls farther away first.
class ProbeBalls {
 public:
  explicit ProbeBalls(vtkRenderer* scene);

  void set(const std::vector<ProbeBall>& balls);
  /// To be called before drawing.
  void update(const Turntable& camera);
  const Bounds& bounds() const { return bounds_; }

 private:
  void add();

  vtkRenderer* scene_;
  vtkSmartPointer<vtkPolyData> unitSphere_;
  std::vector<ProbeBall> balls_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;  ///< drawn in this order; kept when not needed
  Bounds bounds_;
};

}  // namespace palpa::view
