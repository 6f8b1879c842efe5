#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/camera/view_cube.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

class vtkRenderWindow;

namespace palpa::view {

/// The directions of the standard views: looking at the body's front (along +y), and so on.
enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kIsometric };

/// Draws a body: surface, control net, marks, arrows, grid, axes, words; has its camera, and finds
/// the things under a pixel. Knows no window system: it draws into a render window of the caller,
/// from the thread that owns its OpenGL context; picture.h draws without a window. Not thread-safe.
///
/// Setters store; render() draws. Pixel coordinates are device pixels with the
/// origin at the top left, as window systems deliver them. Arrays of wrong lengths and indices out
/// of range throw std::invalid_argument.
///
/// A vtkGenericOpenGLRenderWindow in a Qt widget also needs: SetIsCurrent(true) once, or nothing is
/// drawn; in paintGL the widget's framebuffer bound between a Reset() and Push() of the window's
/// state and a Pop(); and a surface format with DeprecatedFunctions, or Mesa draws all lines one
/// pixel wide.
///
/// Costs with 10,000 points and 20,000 triangles: moveBody(), setFieldValues(), setHandleStates()
/// and a dozen live arrows well below a millisecond each, picking about half a millisecond.
class Viewport {
 public:
  /// `pixelRatio`: device pixels per logical pixel; widths and sizes of handles grow with it. Sets
  /// the window's dots per inch and layers and turns its multisampling off. The window's OpenGL
  /// context, if it has one, must be current here and in the destructor.
  explicit Viewport(vtkRenderWindow* window, double pixelRatio = 1.0);
  ~Viewport();

  void setTheme(const ViewportTheme& theme);
  void setPixelRatio(double ratio);
  double pixelRatio() const;
  /// Pixels of the window per device pixel in each direction, 0.1 … 1: for quick pictures the
  /// caller may make the window smaller by this share and enlarge its picture. All pixel
  /// coordinates stay device pixels.
  void setResolution(double share);
  double resolution() const;
  void setShading(Shading shading);
  void setGridVisible(bool visible);
  void setAxesVisible(bool visible);
  /// A cube with named faces in the upper right corner; hidden at first.
  void setViewCubeVisible(bool visible);
  bool isViewCubeVisible() const;
  void setHoveredCubePart(const std::optional<ViewCubePart>& part);
  void setControlNetVisible(bool visible);
  /// Supports and loads: their regions and the arrows.
  void setRegionsVisible(bool visible);
  void setTouchesVisible(bool visible);
  void setWarningsVisible(bool visible);

  /// A body with new triangles; marks, regions and the field are removed.
  void setBody(const ViewportBody& body);
  /// The same triangles at other places: the quick path while a control point is dragged.
  void moveBody(const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3d>& normals);
  /// One per triangle.
  void setMarks(const std::vector<Mark>& marks);

  void setControlNet(const ControlNet& net);
  void moveControlPoints(const std::vector<Eigen::Vector3d>& points);
  /// One per control point.
  void setHandleStates(const std::vector<HandleState>& states);

  void setLoadArrows(const std::vector<ForceArrow>& arrows);
  void setWarnings(const std::vector<WarningMarker>& warnings);
  void setGizmo(const std::optional<Gizmo>& gizmo);
  void setTouchMarkers(const std::vector<TouchMarker>& markers);
  void setToolDrawing(const ToolDrawing& drawing);
  /// Where supports and loads act: a number per position of the body, below zero inside, so that
  /// their borders are drawn where it is zero, through the triangles. Empty: nowhere. Supports win.
  /// Cheap enough to be set with every moveBody().
  /// `conflict`: the same for a place where two supports contradict each other; it wins.
  void setRegions(const std::vector<double>& supports, const std::vector<double>& loads,
                  const std::vector<double>& conflict = {});

  // Simulation. All of it may be set again for every picture.
  /// Colours the surface by one number per position, beside a colour bar; none: plain. The field
  /// needs a range, so that colours stay while the numbers change: the caller decides when it
  /// grows. Supports are then hatched in grey, and loads only have a border, so that all colours
  /// belong to the field or to marks. NaN has no colour. In the wire picture the lines are
  /// coloured.
  void setField(const std::optional<ScalarField>& field);
  /// The same field with other numbers and another range: the quick path. Throws
  /// std::invalid_argument if there is no field.
  void setFieldValues(const std::vector<double>& values, const std::array<double, 2>& range);
  /// Cuts the body by a plane and fills the section; none: the whole body. setBody() removes it.
  void setSection(const std::optional<SectionDrawing>& section);
  /// The same section of the moved body.
  void moveSection(const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<Eigen::Vector3d>& normals);
  /// Numbers of the field at the points of the section's face, NaN for no colour; the range is the
  /// field's. Call it after setField() and setFieldValues().
  void setSectionValues(const std::vector<double>& values);
  /// Plates are placed so that they do not cover each other. fit() ignores them.
  void setSampleLabels(const std::vector<SampleLabel>& labels);
  /// Dimensions of the body. fit() ignores them.
  void setDimensions(const std::vector<Dimension>& dimensions);
  void setDimensionsVisible(bool visible);
  /// The dimension whose number is at a pixel of the last picture.
  std::optional<int> dimensionAt(const Eigen::Vector2d& pixel) const;
  /// The undeformed shape: thin lines along its borders and knot lines, faint where the body hides
  /// them, and its translucent near side if it has triangles. None to remove it. fit() ignores it.
  /// Its triangles may be coarser than the triangles of the body: drawing them takes time.
  void setGhost(const std::optional<ViewportBody>& body);
  /// Another body, translucent in kComparedColour, with its borders; none to
  /// remove it. The body hides the parts inside it. fit() shows it, too.
  void setCompared(const std::optional<ViewportBody>& body);
  /// The same triangles at other places.
  void moveCompared(const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3d>& normals);
  /// Draws another body, without its regions, instead of the body and its section; the field
  /// colours it. Picking finds the body all the same. None: the body again.
  void setStandIn(const std::optional<ViewportBody>& body);
  /// The same triangles at other places, and numbers of the field (ignored without a field). Call
  /// it after setField() and setFieldValues().
  void moveStandIn(const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<Eigen::Vector3d>& normals, const std::vector<double>& values);
  /// Sizes follow the body of setBody(), not its movement. setRegionsVisible() does not hide them;
  /// fit() ignores them.
  void setLiveArrows(const LiveArrows& arrows);
  /// Arrows at control points, and a legend above the lines of the caption. Sizes follow the body
  /// as above.
  void setGradient(const GradientDrawing& gradient);
  void setContactRings(const std::vector<ContactRing>& rings);
  void setBalls(const std::vector<Ball>& balls);
  /// Title and caption lines around the body; fit() and frame() leave room for them.
  void setCaption(const Caption& caption);

  /// A rectangle between two pixels while selecting; none to remove it.
  void setRubberBand(const std::optional<std::array<Eigen::Vector2d, 2>>& corners);

  // Camera. Orbiting turns about the vertical axis and the horizontal axis of the screen; the
  // focus stays.
  void orbit(const Eigen::Vector2d& pixels);
  /// With `from`, the pixel where the movement begins, the point there follows the pointer exactly;
  /// otherwise a point in the depth of the focus does.
  void pan(const Eigen::Vector2d& pixels, const std::optional<Eigen::Vector2d>& from = {});
  /// Factor > 1 comes nearer; the point under `at` stays there. Ends at a 500th of the body's
  /// radius before the focus, and at 200 radii from it.
  void zoom(double factor, const Eigen::Vector2d& at);
  /// Shows the body, the net if visible, and the arrows, with a margin around them, beside the
  /// colour bar and the caption.
  void fit();
  void fitTo(const std::vector<Eigen::Vector3d>& points);
  /// Turns only: focus and distance stay.
  void lookFrom(StandardView view);
  /// The same for a part of the view cube.
  void lookAtCubePart(const ViewCubePart& part);
  /// Things in the depth of the focus keep their size.
  void setParallelProjection(bool parallel);
  bool parallelProjection() const;
  /// Direction, projection and size. A CameraView has no position: setCamera() looks at the middle
  /// of the things that fit() shows, without a colour bar. A rolled `up` is straightened.
  CameraView camera() const;
  void setCamera(const CameraView& camera);

  /// As setCamera(), but for a picture: shows everything except the ghost, also live arrows, balls
  /// and the points of `room`, beside the colour bar and the caption.
  void frame(const CameraView& camera, const std::vector<Eigen::Vector3d>& room = {});

  // Picking.
  std::optional<SurfaceHit> surfaceAt(const Eigen::Vector2d& pixel) const;
  /// The first point of the section's face on a ray through a pixel, if no part of the body lies
  /// before it; the triangle is the face's.
  std::optional<SurfaceHit> sectionAt(const Eigen::Vector2d& pixel) const;
  /// The control point whose handle is nearest to the pixel, the one in front if several are;
  /// within `reach` logical pixels. A point behind the body counts as half a reach farther away.
  std::optional<int> controlPointAt(const Eigen::Vector2d& pixel, double reach = 9) const;
  /// All within the rectangle, hidden ones too, in ascending order.
  std::vector<int> controlPointsIn(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  /// The polyline of ViewportBody::borders nearest to the pixel, within `reach` logical pixels and
  /// not hidden by the body.
  std::optional<int> borderAt(const Eigen::Vector2d& pixel, double reach = 6) const;
  /// The handle of the gizmo within 8 logical pixels of the pixel.
  GizmoAxis gizmoAt(const Eigen::Vector2d& pixel) const;
  /// The part of the view cube under the pixel, if the cube is visible.
  std::optional<ViewCubePart> cubePartAt(const Eigen::Vector2d& pixel) const;

  // From pixels to lengths.
  /// Between the lines of the grid at the present zoom, mm.
  double gridSpacing() const;
  /// NaN for a point that does not lie in front of the eye.
  Eigen::Vector2d toPixel(const Eigen::Vector3d& point) const;
  /// The point under `pixel` in the plane through `through` parallel to the screen.
  Eigen::Vector3d inViewPlane(const Eigen::Vector2d& pixel, const Eigen::Vector3d& through) const;
  /// The point of the line `through` + s `direction` nearest to the ray under `pixel`; nothing if
  /// the line points at the eye.
  std::optional<Eigen::Vector3d> onLine(const Eigen::Vector2d& pixel,
                                        const Eigen::Vector3d& through,
                                        const Eigen::Vector3d& direction) const;

  /// Draws handles and gizmo once, so that their shaders are compiled before the user needs them:
  /// each takes Mesa a tenth of a second. To be called before anything is selected.
  void warmUp();

  /// Draws everything into the window.
  void render(Quality quality = Quality::kFine);

  /// Triangles of the body in the last picture: fewer than it has while a large body moves.
  std::size_t drawnTriangles() const;

  /// Draws finely and writes the picture of the window as PNG. Throws ViewError.
  void writePng(const std::filesystem::path& path);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpa::view
