#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <optional>

#include "app/view/bounds.h"
#include "app/view/turntable.h"
#include "app/view/viewport_geometry.h"
#include "app/view/viewport_scene.h"

/// The undeformed shape in the interactive view. Internal to app/view.
namespace palpa::view {

/// The near side, denser towards its rim, behind everything else: where the two shapes nearly
/// coincide, a border between "in front" and "behind" would only show rounding errors. To be made
/// right after the body.
class GhostSide {
 public:
  explicit GhostSide(vtkRenderer* scene);
  void set(const ViewportBody& body);
  void setTheme(const ViewportTheme& theme);

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> normals_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkActor> actor_;
};

/// Borders and knot lines; where the body hides them, those of the near side are drawn faintly. To
/// be made after the body.
class GhostLines {
 public:
  GhostLines(vtkRenderer* scene, vtkRenderer* shineThrough);
  void set(const ViewportBody& body);
  /// `field`: the colours of the body, where it is not plain, which the lines must stand out from.
  void setTheme(const ViewportTheme& theme, const std::optional<ScalarField::Colours>& field);
  void setPixelRatio(double ratio);
  /// To be called before drawing.
  void update(const Turntable& camera);
  const Bounds& bounds() const { return bounds_; }

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> outwards_;
  std::array<vtkSmartPointer<vtkActor>, 2> borders_, knotLines_;  ///< solid, faint
  Bounds bounds_;
};

}  // namespace palpa::view
