#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What is drawn, as plain data. Lengths in mm, forces in N, stresses in MPa.
namespace palpa::view {

using Triangle = std::array<int, 3>;

/// Direction of view, projection and size. The position follows from fitting the scene.
struct CameraView {
  Eigen::Vector3d direction{-0.72, 0.58, -0.38};  ///< from the eye into the scene, any length
  Eigen::Vector3d up{0, 0, 1};                    ///< not parallel to `direction`
  bool parallel = false;                          ///< parallel instead of perspective projection
  double zoom = 1;                                ///< > 0; 1 fits the whole scene
};

/// A surface. Points are not shared between patches; normals may jump there.
struct ViewportBody {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;  ///< unit, one per position
  std::vector<Triangle> triangles;       ///< counter-clockwise seen from outside
  std::vector<int> patchOfTriangle;
  std::vector<std::vector<int>> borders;    ///< polylines along the edges of patches
  std::vector<std::vector<int>> knotLines;  ///< polylines at interior knots, drawn faintly
};

/// A polyline for each pair of points.
std::vector<std::vector<int>> linesBetween(const std::vector<std::array<int, 2>>& pairs);

/// Numbers for Viewport::setRegions(), one per point: the region consists of the triangles that
/// `isInside` names, and ends at their common border with the others. Empty without any.
std::vector<double> regionOfTriangles(const std::vector<Triangle>& triangles,
                                      const std::vector<bool>& isInside, std::size_t pointCount);

/// A number per point, drawn as colour.
struct ScalarField {
  std::string name;              ///< written above the colour bar, e.g. "Displacement |u|"
  std::string unit;              ///< e.g. "mm"
  std::vector<double> values{};  ///< one per point; NaN: no colour

  /// Sequential: viridis from the smallest to the largest value. Diverging: blue, white, red, with
  /// white at zero, for fields whose sign matters.
  enum class Colours { kSequential, kDiverging };
  Colours colours = Colours::kSequential;

  /// Smallest and largest value of the colour bar; the data's own if absent.
  std::optional<std::array<double, 2>> range{};

  /// Equal ratios are equally far apart in the colours. All values and the range are above zero;
  /// the colours are sequential.
  bool isLogarithmic = false;
  /// Values above the range (with diverging colours: on both sides of it) exist and are drawn like
  /// its end: the colour bar says so.
  bool isCapped = false;
  /// Smallest and largest value, written below the colour bar; nothing if absent.
  std::optional<std::array<double, 2>> extremes{};
};

/// A section of the body by a plane: the part in front of it is left out, the section is filled.
struct SectionDrawing {
  std::vector<double> distances;  ///< one per point of the body, above zero in front
  ViewportBody face;              ///< may be empty
};

/// Numbers beside a point of the body, on a plate with a line to the point.
struct SampleLabel {
  enum class Kind : std::uint8_t {
    kPointer,  ///< under the pointer
    kPinned,
    kSelected,  ///< pinned
    kMinimum,   ///< of the field
    kMaximum,
  };
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::string text;  ///< one or more lines
  Kind kind = Kind::kPinned;
};

/// A measured length or angle: dimension line, extension lines, arrows, and the number on a plate.
struct Dimension {
  enum class Kind : std::uint8_t {
    kLinear,  ///< two ends
    kAngle,   ///< the corner and the ends of both arms
    kRadius,  ///< the place and the centre
    kCurve,   ///< along an edge
  };
  Kind kind = Kind::kLinear;
  /// mm. Fewer than the kind needs: two as kLinear, one with the number alone, none: not drawn.
  std::vector<Eigen::Vector3d> points;
  std::string text;
  enum class State : std::uint8_t { kPlain, kSelected, kPreview };
  State state = State::kPlain;
};

/// How a triangle of the body is marked; the later one wins where several apply.
enum class Mark : std::uint8_t { kNone, kSupport, kLoad, kHovered, kSelected, kWarning };

/// The control points with the lines of the net between them.
struct ControlNet {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 2>> lines;  ///< pairs of point indices
};

/// How a control point is drawn.
enum class HandleState : std::uint8_t { kPlain, kHovered, kSelected, kFollowing };

/// How the surface is drawn: without lines; with its borders and, faintly, knot lines; or these
/// lines alone, all of them, with a tint on marked triangles.
enum class Shading { kShaded, kShadedWithEdges, kWire };

/// Fine pictures have smooth edges, which doubles the time in software. Quick ones do without.
/// While something moves, large bodies are also drawn with fewer triangles.
enum class Quality { kMoving, kQuick, kFine };

/// A problem at a place of the body, in a few words.
struct WarningMarker {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::string text;
};

/// The first point of the surface on a ray through a pixel.
struct SurfaceHit {
  int triangle = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The handles of the gizmo; kNone: the pointer is on none of them. kAll, in the middle: freely
/// parallel to the screen, about the direction of view, or alike in all directions.
enum class GizmoAxis : std::uint8_t { kNone, kX, kY, kZ, kNormal, kGradient, kAll };

enum class GizmoKind : std::uint8_t { kMove, kRotate, kScale };

/// Handles for moving a selection along fixed directions, turning it about them or scaling it along
/// them, always about 90 pixels large.
struct Gizmo {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal;  ///< unit; a fourth handle along it
  GizmoAxis highlighted = GizmoAxis::kNone;
  GizmoKind kind = GizmoKind::kMove;
  /// Unit; a further handle along the gradient of a stiffness.
  std::optional<Eigen::Vector3d> gradient{};
};

/// A recorded touch: a dot on the surface and an arrow along its displacement or force.
struct TouchMarker {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< any length; zero: no arrow
  std::string label;                                    ///< may be empty
  bool isSelected = false;
};

/// A force, a moment or the weight of the body, drawn as an arrow.
struct ForceArrow {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< mm
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, or N mm; a zero force is not drawn

  /// Which end of the arrow lies at `at`: pulling forces leave the surface, pressing ones end on
  /// it.
  enum class Anchor { kTail, kTip };
  Anchor anchor = Anchor::kTail;

  /// Applied forces are drawn in a strong colour, reactions in a quiet one, gradients in cyan.
  enum class Role {
    kApplied,
    kReaction,
    kGradient,  ///< no force: a motion that makes a touch stiffer
  };
  Role role = Role::kApplied;

  std::string label;  ///< written beside the free end, e.g. "0.134 N"; may be empty

  enum class Kind : std::uint8_t {
    kForce,
    kMoment,  ///< an axis with a curved arrow about it, right-handed, of constant size
    kWeight,  ///< acts inside the body, which does not hide it
  };
  Kind kind = Kind::kForce;
};

/// Length of the arrow for LiveArrows::fullForce, in diagonals of the body at rest.
inline constexpr double kFullArrowLength = 0.25;

/// Forces whose lengths are relative to a given force, so that arrows grow with the force.
struct LiveArrows {
  std::vector<ForceArrow> arrows;
  /// N, > 0: a force as large has the full length. Larger ones are no longer than that; smaller
  /// ones shrink in proportion. Moments do not depend on it.
  double fullForce = 1;
  /// An arrow is at least this share of the full length long; 0: a vanishing force has no arrow.
  double minShare = 0;
};

/// Arrows at control points along the gradient of a stiffness, with a legend.
struct GradientDrawing {
  LiveArrows arrows;                ///< fullForce: the largest gradient, N/mm per mm
  bool isOutdated = false;          ///< drawn faintly: belongs to another touch or shape
  std::vector<std::string> legend;  ///< lines above the caption; may be empty
};

/// A ring around a contact, on the deformed surface.
struct ContactRing {
  enum class State : std::uint8_t {
    kOpen,      ///< near, without force: dashed
    kGrabbed,   ///< fixed to the surface: a grab or a pin
    kSticking,  ///< pressed, friction holds it
    kSlipping,  ///< pressed and sliding: dashed
    kFailed,    ///< the force could not be found and is the last one known: a broken ring
  };
  std::vector<Eigen::Vector3d> points;  ///< a polyline that is closed by its first point
  State state = State::kGrabbed;
};

/// A rigid ball that presses on the body.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;  ///< mm, > 0
};

/// What a tool draws over the scene while it is used.
struct ToolDrawing {
  enum class Style : std::uint8_t {
    kPreview,   ///< the result of the tool: strong
    kGuide,     ///< an axis or plane of the motion: faint
    kHovered,   ///< as hovered handles
    kSelected,  ///< as selected handles
  };
  struct Line {
    std::vector<Eigen::Vector3d> points;
    Style style = Style::kPreview;
    bool isHiddenByBody = true;  ///< otherwise it is drawn over everything
  };
  struct Dot {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Style style = Style::kPreview;
  };
  /// Words on a plate beside a point, over everything.
  struct Label {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    std::string text;
  };
  std::vector<Line> lines;
  std::vector<Dot> dots;
  std::vector<Label> labels;
};

/// Words around the body in a picture without a window.
struct Caption {
  std::string title;               ///< top left
  std::string supports;            ///< explains the hatching, e.g. "held: base"
  std::string compared{};          ///< explains the body of Viewport::setCompared()
  std::vector<std::string> lines;  ///< at the bottom, beside the axes
};

}  // namespace palpa::view
