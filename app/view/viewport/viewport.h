#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/viewport_scene.h"

class vtkRenderWindow;

namespace palpa::view {

/// The directions of the standard views: looking at the body's front (along +y), and so on.
enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kIsometric };

/// The interactive picture of a body: surface, control net, marks, arrows, grid, axes; its camera;
/// and what lies under the pointer. Knows no window system: it draws into a render window given by
/// the caller, from the thread that owns its OpenGL context. Nothing here is thread-safe.
///
/// Setters only note what to draw; render() draws it. Pixel coordinates are device pixels with the
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
  /// context, when it has one, must be current here and in the destructor.
  explicit Viewport(vtkRenderWindow* window, double pixelRatio = 1.0);
  ~Viewport();

  void setTheme(const ViewportTheme& theme);
  void setPixelRatio(double ratio);
  double pixelRatio() const;
  void setShading(Shading shading);
  void setGridVisible(bool visible);
  void setAxesVisible(bool visible);
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
  void setRegions(const std::vector<double>& supports, const std::vector<double>& loads);

  // What happens while one touches. All of it may be set anew for every picture.
  /// Colours the surface by one number per position, beside a scalar bar; none: plain. The field
  /// needs a range, so that colours stay while the numbers change: the caller decides when it
  /// grows. Supports are then hatched in grey, and loads have a border alone, so that the only
  /// colours are those of the field and of marks. Where a number is NaN there is no colour. In the
  /// wire picture the lines are coloured.
  void setField(const std::optional<ScalarField>& field);
  /// The same field with other numbers and another range: the quick path. std::invalid_argument
  /// without a field.
  void setFieldValues(const std::vector<double>& values, const std::array<double, 2>& range);
  /// The undeformed shape: thin lines along its borders and knot lines, faint where the body hides
  /// them, and its translucent near side when it has triangles. None to remove it. It is left out
  /// of fit(). Its triangles need not be as fine as those of the body: drawing them takes time.
  void setGhost(const std::optional<ViewportBody>& body);
  /// Sizes follow the body as setBody() had it. Not hidden by setRegionsVisible(), and left out of
  /// fit().
  void setLiveArrows(const LiveArrows& arrows);
  void setContactRings(const std::vector<ContactRing>& rings);
  void setProbeBalls(const std::vector<ProbeBall>& balls);

  /// A rectangle between two pixels while selecting; none to remove it.
  void setRubberBand(const std::optional<std::array<Eigen::Vector2d, 2>>& corners);

  // Camera. Orbiting turns about the vertical axis and the screen's horizontal one; the point
  // looked at stays.
  void orbit(const Eigen::Vector2d& pixels);
  /// With `from`, the pixel where the movement begins, what lies there follows the pointer exactly;
  /// otherwise what lies in the depth of the point looked at.
  void pan(const Eigen::Vector2d& pixels, const std::optional<Eigen::Vector2d>& from = {});
  /// Factor > 1 comes nearer; what lies under `at` stays there. Ends at a 500th of the body's
  /// radius before the point looked at, and at 200 radii from it.
  void zoom(double factor, const Eigen::Vector2d& at);
  /// Shows the body, the net when it is visible, and the arrows, with a margin around them, beside
  /// the scalar bar when there is one.
  void fit();
  void fitTo(const std::vector<Eigen::Vector3d>& points);
  /// Turns only: the point looked at and the distance stay.
  void lookFrom(StandardView view);
  /// What lies in the depth of the point looked at keeps its size.
  void setParallelProjection(bool parallel);
  bool parallelProjection() const;
  /// Direction, projection and size. As for pictures, a CameraView has no place: setCamera() looks
  /// at the middle of what fit() shows without a scalar bar. A rolled `up` is straightened.
  CameraView camera() const;
  void setCamera(const CameraView& camera);

  // What lies under a pixel.
  std::optional<SurfaceHit> surfaceAt(const Eigen::Vector2d& pixel) const;
  /// The control point whose handle is nearest to the pixel, the one in front when several are;
  /// within `reach` logical pixels. One behind the body counts as half a reach farther away.
  std::optional<int> controlPointAt(const Eigen::Vector2d& pixel, double reach = 9) const;
  /// All within the rectangle, hidden ones too, in ascending order.
  std::vector<int> controlPointsIn(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  /// The polyline of ViewportBody::borders nearest to the pixel, within `reach` logical pixels and
  /// not hidden by the body.
  std::optional<int> borderAt(const Eigen::Vector2d& pixel, double reach = 6) const;
  /// The handle of the gizmo within 8 logical pixels of the pixel.
  GizmoAxis gizmoAt(const Eigen::Vector2d& pixel) const;

  // From pixels to lengths.
  /// NaN for a point that does not lie in front of the eye.
  Eigen::Vector2d toPixel(const Eigen::Vector3d& point) const;
  /// The point under `pixel` in the plane through `through` parallel to the screen.
  Eigen::Vector3d inViewPlane(const Eigen::Vector2d& pixel, const Eigen::Vector3d& through) const;
  /// The point of the line `through` + s `direction` nearest to the ray under `pixel`; nothing when
  /// the line points at the eye.
  std::optional<Eigen::Vector3d> onLine(const Eigen::Vector2d& pixel,
                                        const Eigen::Vector3d& through,
                                        const Eigen::Vector3d& direction) const;

  /// Draws once what a person will soon see, so that its shaders are compiled then: each takes Mesa
  /// a tenth of a second. To be called before anything is selected.
  void warmUp();

  /// Draws everything into the window.
  void render(Quality quality = Quality::kFine);

  /// Draws finely and writes what the window shows as PNG. Throws ViewError.
  void writePng(const std::filesystem::path& path);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpa::view
