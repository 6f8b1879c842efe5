#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/editing/point_selection.h"
#include "modeling/project/project.h"

// What can be done to a project, as plain data: the same commands from the window, from scripts
// (docs/editing.md) and from tests.
namespace palpa::modeling {

/// A plane through a point; the normal need not have length 1.
struct MirrorPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// How far a motion of selected points reaches beyond them.
struct Reach {
  /// Points at a distance r < falloff (mm) from the nearest selected point follow it, weighted by
  /// (1 - (r/falloff)²)².
  std::optional<double> falloff;
  /// Control points at mirrored places (within 1e-6 of the size of the solid) move mirrored, points
  /// in the plane stay in it. Where both of a pair are selected, each gets the mean of both
  /// motions.
  std::optional<MirrorPlane> mirror;
};

struct MoveBy {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< mm
};

/// One position per selected point, in their order (selectPoints).
struct MoveTo {
  std::vector<Eigen::Vector3d> positions;  ///< mm
};

/// Each point along its own outward normal (controlNormals).
struct MoveAlongNormal {
  double distance = 0.0;  ///< mm
};

struct MovePoints {
  PointSelection points;
  std::variant<MoveBy, MoveTo, MoveAlongNormal> how;
  Reach reach;
};

struct ScalePoints {
  PointSelection points;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  std::optional<Eigen::Vector3d> center;  ///< mm; the mean of the selected points when absent
  Reach reach;
};

struct RotatePoints {
  PointSelection points;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double angleDegrees = 0.0;
  std::optional<Eigen::Vector3d> center;  ///< mm; the mean of the selected points when absent
  Reach reach;
};

/// Moves points straight into a plane: through their mean when the offset is absent, and fitted to
/// them by least squares when the normal is absent, too.
struct AlignPoints {
  PointSelection points;
  std::optional<Eigen::Vector3d> normal;
  std::optional<double> offset;  ///< mm from the origin along the unit normal; needs the normal
};

struct InsertKnot {
  std::string patch;
  int direction = 0;  ///< 0: u, 1: v
  double at = 0.5;    ///< parameter
  int times = 1;
};

struct RemoveKnot {
  std::string patch;
  int direction = 0;
  double at = 0.5;
  int times = 1;
  double tolerance = 1e-6;  ///< mm the surface may move at most
};

struct ElevateDegree {
  std::string patch;
  int direction = 0;
  int degree = 4;  ///< the new degree, up to 5
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

/// Moves the whole body, solid or mesh. What is attached to places goes along: half spaces and
/// strokes of regions, bumps and touches. Vectors (displacements, tractions, forces) turn with the
/// body.
struct TransformSolid {
  std::variant<Translation, Rotation, Scaling, MirrorPlane> how;
};

/// Replaces the body; supports and loads stay and must fit its patches.
struct MakePrimitive {
  Primitive primitive;
};

/// Marks an edge, named by one of its two sides, as smooth (and makes it smooth) or as sharp.
struct SetEdge {
  std::string patch;
  Side side = Side::kVMin;
  bool smooth = true;
};

struct AddSupport {
  Support support;
};
struct SetSupport {
  std::string name;  ///< of the support that is replaced, in its place
  Support support;
};
struct RemoveSupport {
  std::string name;
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

struct SetMaterial {
  Material material;
};
struct SetMesh {
  MeshSettings mesh;
};
struct RenameProject {
  std::string name;
};

/// Also in the regions and mesh settings that name the patch.
struct RenamePatch {
  std::string patch;
  std::string name;
};

using Command =
    std::variant<MovePoints, ScalePoints, RotatePoints, AlignPoints, InsertKnot, RemoveKnot,
                 ElevateDegree, TransformSolid, MakePrimitive, SetEdge, AddSupport, SetSupport,
                 RemoveSupport, AddLoad, SetLoad, RemoveLoad, AddTouch, SetTouch, RemoveTouch,
                 SetMaterial, SetMesh, RenameProject, RenamePatch>;

struct Edited {
  Project project;
  double deviation = 0.0;  ///< mm: of remove_knot from the shape before, of make_primitive from the
                           ///< exact shape; otherwise 0
};

/// The project after a command. Where control points move (or an edge is made smooth) strokes of
/// regions go along: each point by the displacement of the surface point nearest to it. A pure
/// function: on failure nothing has happened. Commands that change the solid forget the primitive
/// it was made from.
/// @throws ModelingError that begins with the field that is wrong (`by_mm[0]: …`), or with the path
///         of what would become wrong in the project (`supports[0].where.patches[0]: …`)
Edited apply(const Command& command, const Project& project);

/// What undo menus say: "Move 3 control points", "Add support \"base\"".
std::string label(const Command& command);

/// Unites two motions of the same points that follow each other into the first, so that a drag is
/// one command. False, and nothing changed, when they are of different kinds or points.
bool mergeInto(Command& earlier, const Command& later);

}  // namespace palpa::modeling
