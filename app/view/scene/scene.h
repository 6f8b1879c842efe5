#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

/// Pictures of solids: plain data in, PNG out. Lengths in mm, forces in N, stresses in MPa.
/// Nothing here is thread-safe: VTK draws from one thread at a time.
namespace palpa::view {

using Triangle = std::array<int, 3>;

/// A number per point, drawn as colour.
struct ScalarField {
  std::string name;            ///< as written above the scalar bar, e.g. "Displacement |u|"
  std::string unit;            ///< e.g. "mm"
  std::vector<double> values;  ///< one per point of the scene

  /// Sequential: viridis from the smallest to the largest value. Diverging: blue, white, red, with
  /// white at zero, for fields whose sign matters.
  enum class Colours { kSequential, kDiverging };
  Colours colours = Colours::kSequential;

  /// Smallest and largest value of the scalar bar; the data's own when absent.
  std::optional<std::array<double, 2>> range;

  /// Equal ratios are equally far apart in the colours. All values and the range are above zero;
  /// the colours are sequential.
  bool isLogarithmic = false;
  /// There are larger values than the range has, drawn like its end: the scalar bar says so.
  bool isCapped = false;
};

/// A force drawn as an arrow whose length is proportional to its magnitude (the largest of the
/// scene is `SurfaceScene::arrowLength` long, the smallest drawable one a quarter of that).
struct ForceArrow {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< mm
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N; a zero force is not drawn

  /// Which end of the arrow lies at `at`: pulling forces leave the surface, pressing ones end on
  /// it.
  enum class Anchor { kTail, kTip };
  Anchor anchor = Anchor::kTail;

  /// Applied forces are drawn in a strong colour, reactions in a quiet one.
  enum class Role { kApplied, kReaction };
  Role role = Role::kApplied;

  std::string label;  ///< written beside the free end, e.g. "0.134 N"; may be empty
};

/// The border, on the surface, of all points nearer than `radius` to `center` (undeformed
/// coordinates); it moves with the deformed surface.
struct ContactPatch {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< mm
  double radius = 0;                                 ///< mm, > 0
};

/// A rigid ball that presses on the body: a probe, or the tip of a finger.
struct ProbeBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;  ///< mm, > 0
};

/// How the scene is looked at. Position and distance follow from fitting the scene to the picture.
struct CameraView {
  Eigen::Vector3d direction{-0.72, 0.58, -0.38};  ///< from the eye into the scene, any length
  Eigen::Vector3d up{0, 0, 1};                    ///< not parallel to `direction`
  bool parallel = false;                          ///< parallel instead of perspective projection
  double zoom = 1;                                ///< > 0; 1 fits the whole scene
};

/// A triangulated surface and everything drawn with it.
struct SurfaceScene {
  std::vector<Eigen::Vector3d> positions;      ///< undeformed, mm
  std::vector<Triangle> triangles;             ///< counter-clockwise seen from outside
  std::vector<Eigen::Vector3d> displacements;  ///< mm; one per point, or empty
  double displacementScale = 1;                ///< drawn shape = positions + scale * displacements

  /// Unit normals of the drawn shape, one per point, or empty: then they follow from the triangles
  /// and creaseAngle. With normals, a point on a sharp edge is there once for each side of it.
  std::vector<Eigen::Vector3d> normals;

  std::optional<ScalarField> field;  ///< without one the body has one plain colour

  double creaseAngle = 0.6;    ///< rad; edges whose faces turn by more are drawn sharp
  bool showMeshEdges = false;  ///< thin lines along meshLines; without these along all triangles
  std::vector<std::array<int, 2>> meshLines;  ///< pairs of points
  bool showUndeformed = false;                ///< translucent ghost of the undeformed shape
  std::vector<int> supports;  ///< indices of held triangles, drawn in the support colour
  std::string supportLabel;   ///< words for the support colour, e.g. "held: base"; may be empty
  std::vector<ForceArrow> arrows;
  double arrowLength = 0.32;  ///< of the largest arrow, as a fraction of the body's diagonal
  /// N, of an arrow of that length, so that pictures of a film can be compared; 0: the largest of
  /// the scene.
  double fullForce = 0;
  std::vector<ContactPatch> contactPatches;
  std::vector<ProbeBall> balls;
  /// Places the picture has room for besides what is drawn, mm: those of other pictures of a film.
  std::vector<Eigen::Vector3d> room;

  std::string title;                  ///< top left
  std::vector<std::string> captions;  ///< lines at the bottom
  CameraView camera;

  /// Throws std::invalid_argument naming the field when sizes, indices or numbers are not as
  /// documented above.
  void validate() const;

  /// Where each point is drawn: positions + displacementScale * displacements.
  std::vector<Eigen::Vector3d> deformedPositions() const;
};

}  // namespace palpa::view
