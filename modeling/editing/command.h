#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/project/point_selection.h"
#include "modeling/project/project.h"
#include "modeling/solid/mirror_plane.h"

// Commands that change a project, as plain data. The window, scripts (docs/editing.md) and tests
// use the same commands.
namespace palpa::modeling {

/// Effect of a motion on control points beyond the selected ones.
struct Reach {
  /// Points at a distance r < falloff (mm, > 0) from the nearest selected point follow it, weighted
  /// by (1 - (r/falloff)²)².
  std::optional<double> falloff;
  /// Control points at mirrored places (within 1e-6 of the size of the solid) move mirrored, points
  /// in the plane stay in it. If both points of a pair are selected, each gets the mean of both
  /// motions.
  std::optional<MirrorPlane> mirror;
};

/// Moves all points by the same vector.
struct MoveBy {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< mm
};

/// Moves the points to given positions, in the order of selectPoints().
struct MoveTo {
  std::vector<Eigen::Vector3d> positions;  ///< mm
};

/// Moves each point along its outward normal (controlNormals()).
struct MoveAlongNormal {
  double distance = 0.0;  ///< mm
};

/// Moves control points.
struct MovePoints {
  PointSelection points;
  std::variant<MoveBy, MoveTo, MoveAlongNormal> how;
  Reach reach;
};

/// Scales control points about a centre.
struct ScalePoints {
  PointSelection points;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  std::optional<Eigen::Vector3d> center;  ///< mm; by default the mean of the selected points
  Reach reach;
};

/// Rotates control points about an axis through a centre.
struct RotatePoints {
  PointSelection points;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double angleDegrees = 0.0;
  std::optional<Eigen::Vector3d> center;  ///< mm; by default the mean of the selected points
  Reach reach;
};

/// Projects control points onto a plane. Without an offset the plane contains their mean; without a
/// normal it is the least squares plane.
struct AlignPoints {
  PointSelection points;
  std::optional<Eigen::Vector3d> normal;
  std::optional<double> offset;  ///< mm from the origin along the unit normal; needs the normal
};

/// Inserts a knot without changing the surface.
struct InsertKnot {
  std::string patch;
  int direction = 0;  ///< 0: u, 1: v
  double at = 0.5;    ///< parameter
  int times = 1;
};

/// Removes a knot.
struct RemoveKnot {
  std::string patch;
  int direction = 0;        ///< 0: u, 1: v
  double at = 0.5;          ///< parameter
  int times = 1;            ///< number of multiplicities to remove
  double tolerance = 1e-6;  ///< largest motion of the surface, mm
};

/// Raises the degree without changing the surface.
struct ElevateDegree {
  std::string patch;
  int direction = 0;  ///< 0: u, 1: v
  int degree = 4;     ///< the new degree, up to 5
};

struct Translation {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< mm
};

struct Rotation {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double angleDegrees = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< mm
};

struct Scaling {
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();  ///< each greater than 0
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< mm
};

/// Transforms the whole body, solid or mesh, with everything attached to places: half spaces and
/// strokes of regions, bumps and touches. Vectors (displacements, tractions, forces) turn with the
/// body.
struct TransformSolid {
  std::variant<Translation, Rotation, Scaling, MirrorPlane> how;
};

/// Replaces the body. Supports and loads remain and must fit its patches.
struct MakePrimitive {
  Primitive primitive;
};

/// Marks an edge, given by one of its two sides, as smooth (and makes it smooth) or as sharp.
struct SetEdge {
  std::string patch;
  Side side = Side::kVMin;
  bool smooth = true;
};

struct AddSupport {
  Support support;
};
/// Replaces a support, load, touch or measurement at its position in the list.
struct SetSupport {
  std::string name;  ///< of the replaced support
  Support support;
};
struct RemoveSupport {
  std::string name;
};
/// Gives the surface that two supports share to one of them: the region of the other gets the
/// regions of the taker as exceptions. A support of which nothing is left is removed.
struct TakeOverlap {
  std::string name;  ///< the support that keeps the overlap
  std::string from;  ///< the support that loses it
  double gap = 0.0;  ///< mm of free surface between both, >= 0; supports that prescribe different
                     ///< displacements must not meet
};

struct AddLoad {
  Load load;
};
struct SetLoad {
  std::string name;
  Load load;
};
struct RemoveLoad {
  std::string name;
};

struct AddTouch {
  Touch touch;
};
struct SetTouch {
  std::string name;
  Touch touch;
};
struct RemoveTouch {
  std::string name;
};

struct AddMeasurement {
  Measurement measurement;
};
struct SetMeasurement {
  std::string name;
  Measurement measurement;
};
struct RemoveMeasurement {
  std::string name;
};

struct SetMaterial {
  Material material;
};
struct SetMesh {
  MeshSettings mesh;
};
/// Replaces the settings of the search for a shape; none removes them.
struct SetDesign {
  std::optional<Design> design;
};
struct RenameProject {
  std::string name;
};

/// Renames a patch, also in regions and mesh settings.
struct RenamePatch {
  std::string patch;
  std::string name;
};

using Command =
    std::variant<MovePoints, ScalePoints, RotatePoints, AlignPoints, InsertKnot, RemoveKnot,
                 ElevateDegree, TransformSolid, MakePrimitive, SetEdge, AddSupport, SetSupport,
                 RemoveSupport, TakeOverlap, AddLoad, SetLoad, RemoveLoad, AddTouch, SetTouch,
                 RemoveTouch, AddMeasurement, SetMeasurement, RemoveMeasurement, SetMaterial,
                 SetMesh, SetDesign, RenameProject, RenamePatch>;

/// Result of a command.
struct Edited {
  Project project;
  double deviation = 0.0;  ///< mm; of RemoveKnot: from the previous shape; of MakePrimitive: from
                           ///< the exact shape; otherwise 0
};

/// The project after a command. If control points move (or an edge is made smooth), strokes of
/// regions move with the surface (carryStrokes()). Commands that change the solid remove the
/// primitive from the project. A pure function: the argument does not change.
/// Throws ModelingError that begins with the wrong field (`by_mm[0]: …`), or with the path of the
/// value that would become invalid in the project (`supports[0].where.patches[0]: …`).
Edited apply(const Command& command, const Project& project);

/// Label for undo menus: "Move 3 control points", "Add support \"base\"".
std::string label(const Command& command);

/// Merges two consecutive motions of the same points into the first, so that a drag is one command.
/// Returns false without changes if the kinds or points differ.
bool mergeInto(Command& earlier, const Command& later);

}  // namespace palpa::modeling
