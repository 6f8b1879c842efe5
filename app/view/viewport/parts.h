#pragma once

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "app/view/camera/triangle_boxes.h"
#include "app/view/camera/turntable.h"
#include "app/view/layers/caption_layer.h"
#include "app/view/layers/colour_bar.h"
#include "app/view/layers/compared_body.h"
#include "app/view/layers/contact_layer.h"
#include "app/view/layers/control_net_actor.h"
#include "app/view/layers/dimension_layer.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/force_arrows.h"
#include "app/view/layers/ghost_actor.h"
#include "app/view/layers/gizmo_actor.h"
#include "app/view/layers/grid_actor.h"
#include "app/view/layers/orientation_axes.h"
#include "app/view/layers/sample_layer.h"
#include "app/view/layers/surface_actor.h"
#include "app/view/layers/tool_layer.h"
#include "app/view/layers/view_cube_actor.h"
#include "app/view/layers/warning_signs.h"
#include "app/view/viewport/viewport.h"

/// Internal to app/view.
namespace palpa::view {

/// State and layers of a Viewport.
struct Viewport::Parts {
  Parts(vtkRenderWindow* renderWindow, double ratio);
  ~Parts();

  /// Takes over the size of the window, in device pixels at full resolution.
  void syncSize();
  /// Device pixels per logical pixel of what the caller passes; `pixelRatio` is for drawing.
  double inputRatio() const { return pixelRatio / resolution; }
  /// After lengths in the scene have changed.
  void syncBounds();
  void remakeArrows();
  void remakeLiveArrows();
  void remakeGradientArrows();
  /// After the field, except its values, or the theme has changed.
  void applyField();
  void remakeCaption();
  void remakeWarnings();
  void remakeTouches();
  void remakeTool();
  void remakeSamples();
  void remakeDimensions();
  void applyTheme();
  void applyCamera();
  /// Viewport::setCamera(), showing the points beside the reserve.
  void look(const CameraView& view, const std::vector<Eigen::Vector3d>& points,
            const Reserve& reserve);
  void updateOverlay();
  /// The gizmo where it is drawn: its handles in the picture.
  std::optional<Gizmo> shownGizmo(double ratio) const;

  /// Everything that fit() shows.
  std::vector<Eigen::Vector3d> shownPoints() const;
  double fitMargin() const;
  /// Pixels that fit() leaves to the colour bar and the caption; `withWords`: to the words of the
  /// bar, too.
  Reserve fitReserve(bool withWords);
  double bodyDiagonal() const;
  /// The point under a pixel: on the surface, or in the plane through the focus.
  Eigen::Vector3d pointUnder(const Eigen::Vector2d& pixel) const;
  std::optional<RayHit> firstHit(const Ray& ray) const;
  /// True if the body lies between the eye and the point.
  bool hidden(const Eigen::Vector3d& point) const;

  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkCamera> vtkView;
  vtkNew<vtkRenderer> scene;         ///< background, grid, body, net, arrows
  vtkNew<vtkRenderer> shineThrough;  ///< faint copies of what the body may hide
  vtkNew<vtkRenderer> overlay;       ///< gizmo, signs, labels: in front of everything

  Turntable camera;
  ViewportTheme theme = ViewportTheme::light();
  double pixelRatio;      ///< pixels of the window per logical pixel
  double resolution = 1;  ///< pixels of the window per device pixel

  ViewportBody body;
  TriangleBoxes bodyBoxes;
  ControlNet net;
  bool netVisible = true;
  std::optional<SectionDrawing> section;  ///< with the moved face
  TriangleBoxes faceBoxes;
  std::optional<ViewportBody> standIn;
  std::vector<SampleLabel> samples;
  std::vector<Dimension> dimensions;
  std::vector<ForceArrow> forces;
  LiveArrows liveForces;
  GradientDrawing gradient;
  double restDiagonal;               ///< of the body before it moved: sizes do not follow its shape
  std::optional<ScalarField> field;  ///< without values
  std::vector<WarningMarker> warnings;
  std::optional<Gizmo> gizmo;
  std::vector<TouchMarker> touches;
  ToolDrawing toolDrawing;
  Caption caption;
  std::optional<std::array<Eigen::Vector2d, 2>> rubberBand;
  Bounds bodyBounds, netBounds;

  // Drawn below the texts, and smoothed in fine pictures like everything below the overlay.
  FlatShapes shapes;
  // Within a renderer, later actors are blended over earlier ones.
  SurfaceActor surface;
  SurfaceActor sectionFace;
  SurfaceActor standInSurface;
  GhostSide ghostSide;
  GridActor grid;
  ControlNetActor netActor;
  GhostLines ghostLines;
  ComparedBody compared;
  ForceArrows arrows;
  ContactRings rings;
  ForceArrows liveArrows;
  ForceArrows gradientArrows;
  ToolLayer tool;
  TouchLayer touchLayer;
  SampleLayer sampleLayer;
  DimensionLayer dimensionLayer;
  WarningSigns signs;
  OrientationAxes axes;
  ViewCubeActor viewCube;
  GizmoActor gizmoActor;
  ColourBar colourBar;
  CaptionLayer captionLayer;
  Balls balls;
};

}  // namespace palpa::view
