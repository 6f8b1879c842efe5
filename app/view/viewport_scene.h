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

/// The axes of the gizmo; kNone: the pointer is on none of them.
enum class GizmoAxis : std::uint8_t { kNone, kX, kY, kZ, kNormal };

/// Handles for moving a selection along fixed directions, always about 90 pixels large.
struct Gizmo {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal;  ///< unit; a fourth handle along it
  GizmoAxis highlighted = GizmoAxis::kNone;
};

/// Colours of the window's light and dark appearance.
struct ViewportTheme {
  Colour backgroundTop, backgroundBottom;
  Colour body, support, load, hovered, selected, warning;
  Colour line, net, handle, handleHovered, handleSelected, handleFollowing;
  Colour grid, text;

  static ViewportTheme light();
  static ViewportTheme dark();
};

}  // namespace palpa::view
