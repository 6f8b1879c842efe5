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

/// The traction direction · peak · (1 − (ρ/radius)²)² for ρ = |x − center| < radius.
struct Bump {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();       ///< mm
  double radius = 1.0;                                    ///< mm, > 0
  double peak = 0.0;                                      ///< MPa
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< as given, not normalised

  bool operator==(const Bump&) const = default;
};

/// A named load: a traction on part of the surface.
struct Load {
  std::string name;
  std::variant<Pressure, UniformTraction, Bump> what;

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
  MeshSettings mesh;
  /// View of the project in the window: a JSON object as text that only the window interprets,
  /// empty for none. Loading and saving preserve it, including the order of its keys.
  std::string view;
};

/// Checks a project except for its body (which checks itself): ranges, finite numbers, regions that
/// fit the body, names that are not empty and unique among supports, loads and touches. Throws
/// ModelingError that begins with the path in the file:
/// `supports[0].where.patches[1]: no patch is named …`.
void checkProject(const Project& project);

/// The regions for fitting a mesh: the regions of all supports in order, then the regions of the
/// loads in order (bumps have none). Borders of supports are refined on request, borders of loads
/// are not. Names begin with the path: `supports[0] "base"`.
std::vector<MeshRegion> meshRegions(const Project& project);

/// The region of a load; null for a bump, which has a radius instead.
const Region* regionOf(const Load& load);

}  // namespace palpa::modeling
