#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/body/region.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/project/design.h"
#include "modeling/project/measurement.h"
#include "modeling/project/touch_kind.h"
#include "modeling/shapes/primitive.h"

namespace palpa::modeling {

/// Isotropic linear elastic material.
struct Material {
  std::string name;
  double youngsModulus = 1.0;  ///< MPa, > 0
  double poissonRatio = 0.45;  ///< -1 < nu <= 0.5
  /// kg/m^3, > 0; needed for gravity alone.
  std::optional<double> densityKgPerM3{};

  bool operator==(const Material&) const = default;
};

/// Region with prescribed displacements: of all components (fixed) or of the normal one (roller).
struct Support {
  enum class Kind { kFixed, kRoller };
  std::string name;
  Kind kind = Kind::kFixed;
  Region where;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm, prescribed on the region

  bool operator==(const Support&) const = default;
};

/// Pressure on a region, MPa, positive into the body.
struct Pressure {
  Region where;
  double pressure = 0.0;

  bool operator==(const Pressure&) const = default;
};

/// Uniform traction (MPa) on a region.
struct UniformTraction {
  Region where;
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();

  bool operator==(const UniformTraction&) const = default;
};

/// Total force (N) on a region, spread as a uniform traction.
struct TotalForce {
  Region where;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();

  bool operator==(const TotalForce&) const = default;
};

/// Moment (N mm) on a region without a net force: the traction w × (x − c) with the region's
/// centroid c.
struct Moment {
  Region where;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();

  bool operator==(const Moment&) const = default;
};

/// Weight of the whole body: density times acceleration per volume.
struct Gravity {
  static constexpr double kStandard = 9.80665;  ///< m/s^2, on the earth
  Eigen::Vector3d accelerationMPerS2{0, 0, -kStandard};

  bool operator==(const Gravity&) const = default;
};

/// The traction direction · peak · (1 − (ρ/radius)²)² for ρ = |x − center| < radius.
struct Bump {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();       ///< mm
  double radius = 1.0;                                    ///< mm, > 0
  double peak = 0.0;                                      ///< MPa
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< as given, not normalised

  bool operator==(const Bump&) const = default;
};

/// A named load: a traction on part of the surface, or a force on the whole volume.
struct Load {
  std::string name;
  std::variant<Pressure, UniformTraction, Bump, TotalForce, Moment, Gravity> what;

  bool operator==(const Load&) const = default;
};

/// A recorded touch. All touches of a project act at the same time; docs/project-file.md describes
/// the effect of each kind together with loads and other touches.
struct Touch {
  std::string name;
  /// Place (mm) on the unloaded shape; for kinds that press, the place of first contact.
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  TouchKind kind = TouchKind::kGrab;
  /// Displacement (mm) or force (N), see TouchKind.
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  /// Radius of the mask or the ball, mm, > 0; by default the radius of a fingertip.
  std::optional<double> radius{};
  double friction = 0.0;  ///< Coulomb's coefficient, 0 … kMaxFriction, of a kind that presses

  bool operator==(const Touch&) const = default;
};

/// Content of a project file.
struct Project {
  std::string name;
  Material material;
  Body body;
  /// The primitive that the solid was made from, until other commands edit the solid.
  std::optional<Primitive> primitive;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Touch> touches;
  std::vector<Measurement> measurements{};
  std::optional<Design> design{};  ///< what it should feel like, for the search for a shape
  MeshSettings mesh;
  /// View of the project in the window: a JSON object as text that only the window interprets,
  /// empty for none. Loading and saving preserve it, including the order of its keys.
  std::string view;
};

/// Checks a project except for its body (which checks itself): ranges, finite numbers, regions that
/// fit the body, names that are not empty and unique in each list. Throws
/// ModelingError that begins with the path in the file:
/// `supports[0].where.patches[1]: no patch is named …`.
void checkProject(const Project& project);

/// The regions for fitting a mesh: the regions of all supports in order, then the regions of the
/// loads in order (bumps and gravity have none). Borders of supports are refined on request,
/// borders of loads are not. Names begin with the path: `supports[0] "base"`.
std::vector<MeshRegion> meshRegions(const Project& project);

/// The engine that computes the project, see engineFor(): never automatic.
Engine engineOf(const Project& project);

/// The region of a load; null for a bump, which has a radius instead, and for gravity.
const Region* regionOf(const Load& load);
Region* regionOf(Load& load);

/// Weight per volume, N/mm^3, by the load with this index, which is gravity. Throws ModelingError
/// if the material has no density.
Eigen::Vector3d weightPerVolume(const Project& project, std::size_t load);

}  // namespace palpa::modeling
