#pragma once

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "app/view/colour_bar.h"
#include "app/view/contact_layer.h"
#include "app/view/control_net_actor.h"
#include "app/view/flat_shapes.h"
#include "app/view/force_arrows.h"
#include "app/view/ghost_actor.h"
#include "app/view/gizmo_actor.h"
#include "app/view/grid_actor.h"
#include "app/view/orientation_axes.h"
#include "app/view/surface_actor.h"
#include "app/view/tool_layer.h"
#include "app/view/triangle_boxes.h"
#include "app/view/turntable.h"
#include "app/view/viewport.h"
#include "app/view/warning_signs.h"

/// Internal to app/view.
namespace palpa::view {

/// What a Viewport consists of.
struct Viewport::Parts {
  Parts(vtkRenderWindow* renderWindow, double ratio);
  ~Parts();

  /// Takes over the size of the window.
  void syncSize();
  /// After lengths in the scene have changed.
  void syncBounds();
  void remakeArrows();
  void remakeLiveArrows();
  /// After the field, but for its values, or the theme has changed.
  void applyField();
  void remakeWarnings();
  void remakeTouches();
  void remakeTool();
  void applyTheme();
  void applyCamera();
  void updateOverlay();

  /// Everything that fit() shows.
  std::vector<Eigen::Vector3d> shownPoints() const;
  double fitMargin() const;
  /// Pixels at the right edge that fit() leaves to the scalar bar.
  double fitReserve();
  double bodyDiagonal() const;
  /// What lies under a pixel: the surface, or the plane through the focus.
  Eigen::Vector3d pointUnder(const Eigen::Vector2d& pixel) const;
  std::optional<RayHit> firstHit(const Ray& ray) const;
  /// True when the body lies between the eye and the point.
  bool hidden(const Eigen::Vector3d& point) const;

  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkCamera> vtkView;
  vtkNew<vtkRenderer> scene;         ///< background, grid, body, net, arrows
  vtkNew<vtkRenderer> shineThrough;  ///< faint copies of what the body may hide
  vtkNew<vtkRenderer> overlay;       ///< gizmo, signs, labels: in front of everything

  Turntable camera;
  ViewportTheme theme = ViewportTheme::light();
  double pixelRatio;

  ViewportBody body;
  TriangleBoxes bodyBoxes;
  ControlNet net;
  bool netVisible = true;
  std::vector<ForceArrow> forces;
  LiveArrows liveForces;
  double restDiagonal;               ///< of the body before it moved: sizes do not follow its shape
  std::optional<ScalarField> field;  ///< without values
  std::vector<WarningMarker> warnings;
  std::optional<Gizmo> gizmo;
  std::vector<TouchMarker> touches;
  ToolDrawing toolDrawing;
  std::optional<std::array<Eigen::Vector2d, 2>> rubberBand;
  Bounds bodyBounds, netBounds;

  // Drawn below the texts, and smoothed in fine pictures with all that the overlay covers.
  FlatShapes shapes;
  // Within a renderer, what is added later is blended over what was added before.
  SurfaceActor surface;
  GhostSide ghostSide;
  GridActor grid;
  ControlNetActor netActor;
  GhostLines ghostLines;
  ForceArrows arrows;
  ContactRings rings;
  ForceArrows liveArrows;
  ToolLayer tool;
  TouchLayer touchLayer;
  WarningSigns signs;
  OrientationAxes axes;
  GizmoActor gizmoActor;
  ColourBar colourBar;
  ProbeBalls balls;
};

}  // namespace palpa::view
