#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/body/region.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/project/touch_kind.h"
#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Isotropic linear elastic material.
struct Material {
  std::string name;
  double youngsModulus = 1.0;  ///< MPa, > 0
  double poissonRatio = 0.45;  ///< -1 < nu <= 0.5
};

struct Support {
  enum class Kind { kFixed, kRoller };
  std::string name;
  Kind kind = Kind::kFixed;
  Region where;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm, prescribed on the region
};

/// Pressure on a region, MPa, positive into the body.
struct Pressure {
  Region where;
  double pressure = 0.0;
};

/// The same traction (MPa) in every point of a region.
struct UniformTraction {
  Region where;
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
};

/// The traction direction · peak · (1 − (ρ/radius)²)² for ρ = |x − center| < radius.
struct Bump {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();       ///< mm
  double radius = 1.0;                                    ///< mm, > 0
  double peak = 0.0;                                      ///< MPa
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< as given, not normalised
};

struct Load {
  std::string name;
  std::variant<Pressure, UniformTraction, Bump> what;
};

inline constexpr double kMaxFriction = 10.0;

/// A recorded touch. All touches of a project act at the same time; docs/project-file.md says what
/// each kind does beside loads and other touches.
struct Touch {
  std::string name;
  /// mm, on the unloaded shape; where a kind that presses first meets the surface.
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  TouchKind kind = TouchKind::kGrab;
  /// Displacement (mm) or force (N), see TouchKind.
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  /// mm, > 0; of the mask or the ball; that of a fingertip when absent.
  std::optional<double> radius{};
  double friction = 0.0;  ///< Coulomb's coefficient, 0 … kMaxFriction, of a kind that presses
};

/// Everything a project file holds.
struct Project {
  std::string name;
  Material material;
  Body body;
  /// What the solid was made from, as long as it was not edited otherwise.
  std::optional<Primitive> primitive;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Touch> touches;
  MeshSettings mesh;
  /// How the window showed the project: a JSON object as text that only the window understands,
  /// empty for none. Kept through load and save, key order included.
  std::string view;
};

/// Checks everything but the body (which checks itself): ranges, finite numbers, names not empty,
/// unique among supports and among loads, regions that fit the body. Messages begin with the path
/// as in the file: `supports[0].where.patches[1]: no patch is named …`. @throws ModelingError
void checkProject(const Project& project);

/// The regions to fit a mesh to: those of all supports in order, then those of the loads that have
/// one, in order. Borders of supports are refined on request, borders of loads are not. The name of
/// each begins with its path: `supports[0] "base"`.
std::vector<MeshRegion> meshRegions(const Project& project);

/// The region a load acts on; null for a bump, which carries its own extent.
const Region* regionOf(const Load& load);

}  // namespace palpa::modeling
