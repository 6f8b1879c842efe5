#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <optional>

#include "app/view/camera/bounds.h"
#include "app/view/camera/turntable.h"
#include "app/view/layers/rim_surface.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// The undeformed shape. Internal to app/view.
namespace palpa::view {

/// The near side, denser towards its rim, behind everything else: where the two shapes nearly
/// coincide, a border between "in front" and "behind" would only show rounding errors. Create it
/// right after the body.
class GhostSide {
 public:
  explicit GhostSide(vtkRenderer* scene);
  void set(const ViewportBody& body) { surface_.set(body); }
  void setTheme(const ViewportTheme& theme);

 private:
  RimSurface surface_;
};

/// Borders and knot lines; the hidden ones of the near side are drawn faintly. Create it after the
/// body.
class GhostLines {
 public:
  GhostLines(vtkRenderer* scene, vtkRenderer* shineThrough);
  void set(const ViewportBody& body);
  /// `field`: the colours of the body, if any: the lines contrast with them.
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
