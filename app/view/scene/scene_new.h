#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/view/scene.h"

// What the interactive view shows, as plain data. Lengths in mm, forces in N.
namespace palpa::view {

using Colour = std::array<double, 3>;  // red, green, blue: 0 … 1

/// The body being modelled. Points are not shared between patches; normals may jump there.
struct ViewportBody {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;  ///< unit, one per position
  std::vector<Triangle> triangles;       ///< counter-clockwise seen from outside
  std::vector<int> patchOfTriangle;
  std::vector<std::vector<int>> borders;    ///< polylines along the edges of patches
  std::vector<std::vector<int>> knotLines;  ///< polylines at interior knots, drawn faintly
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

/// Edges are smoothed in fine pictures. Drawn in software that costs twice the time: quick ones are
/// for while something moves.
enum class Quality { kQuick, kFine };

/// A place the person should look at, with a word about what is wrong.
struct WarningMarker {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::string text;
};

/// What the mouse ray meets first.
struct SurfaceHit {
  int triangle = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The handles of the gizmo; kNone: the pointer is on none of them. kAll, in the middle: freely
/// parallel to the screen, about the direction of view, or alike in all directions.
enum class GizmoAxis : std::uint8_t { kNone, kX, kY, kZ, kNormal, kAll };

enum class GizmoKind : std::uint8_t { kMove, kRotate, kScale };

/// Handles for moving a selection along fixed directions, turning it about them or scaling it along
/// them, always about 90 pixels large.
struct Gizmo {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal;  ///< unit; a fourth handle along it
  GizmoAxis highlighted = GizmoAxis::kNone;
  GizmoKind kind = GizmoKind::kMove;
};

/// A recorded touch: a dot on the surface and an arrow along its displacement or force.
struct TouchMarker {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< any length; zero: no arrow
  std::string label;                                    ///< may be empty
  bool isSelected = false;
};

/// Forces that change while one presses. Their lengths are relative to a given force, not to the
/// largest of the moment, so that arrows grow with the force.
struct LiveArrows {
  std::vector<ForceArrow> arrows;
  /// N, > 0: a force as large is drawn a quarter of the body's diagonal long. Larger ones are no
  /// longer than that; smaller ones shrink in proportion, down to nothing.
  double fullForce = 1;
};

/// A ring around a contact, on the deformed surface.
struct ContactRing {
  enum class State : std::uint8_t {
    kOpen,      ///< near, without force: dashed
    kHolding,   ///< fixed to the surface: a grab or a pin
    kSticking,  ///< pressed, friction holds it
    kSlipping,  ///< pressed and sliding: dashed
    kFailed,    ///< the force could not be found and is the last one known: a broken ring
  };
  std::vector<Eigen::Vector3d> points;  ///< a polyline that is closed by its first point
  State state = State::kHolding;
};

/// What a tool draws over the scene while it is used.
struct ToolDrawing {
  enum class Style : std::uint8_t {
    kPreview,   ///< what would be made: strong
    kGuide,     ///< what holds a motion: an axis, a plane; faint
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

/// Colours of the window's light and dark appearance.
struct ViewportTheme {
  Colour backgroundTop, backgroundBottom;
  Colour body, support, load, hovered, selected, warning;
  Colour line, net, handle, handleHovered, handleSelected, handleFollowing;
  Colour grid, text;
  Colour preview, touch;

  static ViewportTheme light();
  static ViewportTheme dark();
};

}  // namespace palpa::view
