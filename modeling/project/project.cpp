#include "modeling/project/project.h"

#include <cmath>
#include <set>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/mesh/engine_choice.h"
#include "modeling/project/missing_density.h"

namespace palpa::modeling {
namespace {

std::string indexed(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void requireFinite(const Eigen::Vector3d& value, const std::string& path) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(value[axis]))
      throw ModelingError(path + "[" + std::to_string(axis) + "]: must be finite");
}

void requireFinite(double value, const std::string& path) {
  if (!std::isfinite(value)) throw ModelingError(path + ": must be finite");
}

void requirePositive(double value, const std::string& path) {
  if (!std::isfinite(value) || value <= 0.0)
    throw ModelingError(path + ": " + numberText(value) + " must be finite and greater than 0");
}

void requireNotZero(const Eigen::Vector3d& value, const std::string& path) {
  if (value.norm() == 0.0) throw ModelingError(path + ": must not be zero");
}

/// Throws ModelingError if a name is empty or used twice in its list.
void checkName(const std::string& name, const std::string& path, std::set<std::string>& names) {
  if (name.empty()) throw ModelingError(path + ".name: is empty");
  if (!names.insert(name).second)
    throw ModelingError(path + ".name: \"" + name + "\" is used twice in this list");
}

void checkMaterial(const Material& material) {
  const auto& [name, youngsModulus, nu, density] = material;
  requirePositive(youngsModulus, "material.youngs_modulus_MPa");
  if (density) requirePositive(*density, "material.density_kg_per_m3");
  if (!(nu > -1.0 && nu <= 0.5))
    throw ModelingError("material.poisson_ratio: " + numberText(nu) +
                        " is outside the possible range -1 < nu <= 0.5");
}

/// The body and its patch names, for all regions.
struct Surface {
  const Body& body;
  std::set<std::string> names;

  void check(const Region& region, const std::string& path) const {
    checkRegion(region, body, names, path);
  }
};

void checkLoad(const Pressure& load, const Surface& surface, const std::string& path) {
  surface.check(load.where, path + ".where");
  requireFinite(load.pressure, path + ".MPa");
}

void checkLoad(const UniformTraction& load, const Surface& surface, const std::string& path) {
  surface.check(load.where, path + ".where");
  requireFinite(load.traction, path + ".MPa");
}

void checkLoad(const TotalForce& load, const Surface& surface, const std::string& path) {
  surface.check(load.where, path + ".where");
  requireFinite(load.force, path + ".force_N");
}

void checkLoad(const Moment& load, const Surface& surface, const std::string& path) {
  surface.check(load.where, path + ".where");
  requireFinite(load.moment, path + ".moment_N_mm");
}

void checkLoad(const Gravity& load, const Surface&, const std::string& path) {
  requireFinite(load.accelerationMPerS2, path + ".acceleration_m_per_s2");
}

void checkLoad(const Bump& load, const Surface&, const std::string& path) {
  requireFinite(load.center, path + ".center_mm");
  requirePositive(load.radius, path + ".radius_mm");
  requireFinite(load.peak, path + ".peak_MPa");
  requireFinite(load.direction, path + ".direction");
  requireNotZero(load.direction, path + ".direction");
}

void checkTouch(const Touch& touch, const std::string& path) {
  requireFinite(touch.at, path + ".at_mm");
  if (touch.radius) requirePositive(*touch.radius, path + ".radius_mm");
  requireFinite(touch.vector, path + "." + infoOf(touch.kind).vectorKey());
  if (!(touch.friction >= 0.0 && touch.friction <= kMaxFriction))
    throw ModelingError(path + ".friction: " + numberText(touch.friction) +
                        " is outside the range 0 … " + numberText(kMaxFriction));
}

}  // namespace

void checkProject(const Project& project) {
  const std::vector<std::string> patches = patchNames(project.body);
  const Surface surface{project.body, {patches.begin(), patches.end()}};
  checkMaterial(project.material);
  std::set<std::string> names;
  for (std::size_t i = 0; i < project.supports.size(); ++i) {
    const Support& support = project.supports[i];
    const std::string path = indexed("supports", i);
    checkName(support.name, path, names);
    surface.check(support.where, path + ".where");
    requireFinite(support.displacement, path + ".displacement_mm");
  }
  names.clear();
  for (std::size_t i = 0; i < project.loads.size(); ++i) {
    const std::string path = indexed("loads", i);
    checkName(project.loads[i].name, path, names);
    std::visit([&](const auto& load) { checkLoad(load, surface, path); }, project.loads[i].what);
  }
  names.clear();
  for (std::size_t i = 0; i < project.touches.size(); ++i) {
    const std::string path = indexed("touches", i);
    checkName(project.touches[i].name, path, names);
    checkTouch(project.touches[i], path);
  }
  names.clear();
  for (std::size_t i = 0; i < project.measurements.size(); ++i) {
    const std::string path = indexed("measurements", i);
    checkName(project.measurements[i].name, path, names);
    checkMeasurement(project.measurements[i], path);
  }
  if (project.design) {
    std::vector<std::string> touches;
    for (const Touch& touch : project.touches) touches.push_back(touch.name);
    checkDesign(*project.design, touches, "design");
  }
  project.mesh.validate("mesh");
  for (const auto& [patch, factor] : project.mesh.patchFactors)
    if (!surface.names.contains(patch))
      throw ModelingError("mesh.patch_factors." + patch +
                          ": no patch has this name; the body has " +
                          quotedPatchNames(project.body));
  if (project.mesh.engine == Engine::kSplines && !std::holds_alternative<Solid>(project.body))
    throw ModelingError(
        "mesh.engine: a mesh body has no spline patches; select automatic, triangles or quadratic");
  if (project.primitive && !std::holds_alternative<Solid>(project.body))
    throw ModelingError("primitive: a mesh body is not made from a primitive");
}

namespace {

/// `Result`: Region* or const Region*.
template <class Result, class AnyLoad>
Result regionIn(AnyLoad& load) {
  return std::visit(
      [](auto& what) -> Result {
        if constexpr (requires { what.where; })
          return &what.where;
        else
          return nullptr;
      },
      load.what);
}

}  // namespace

Region* regionOf(Load& load) {
  return regionIn<Region*>(load);
}

const Region* regionOf(const Load& load) {
  return regionIn<const Region*>(load);
}

Eigen::Vector3d weightPerVolume(const Project& project, std::size_t load) {
  constexpr double kCubicMmPerM3 = 1e9;
  if (!project.material.densityKgPerM3)
    throw MissingDensityError(indexed("loads", load) + " \"" + project.loads[load].name +
                              "\": gravity needs the density of the material; set "
                              "material.density_kg_per_m3");
  return *project.material.densityKgPerM3 / kCubicMmPerM3 *
         std::get<Gravity>(project.loads[load].what).accelerationMPerS2;
}

std::vector<MeshRegion> meshRegions(const Project& project) {
  std::vector<MeshRegion> regions;
  for (std::size_t i = 0; i < project.supports.size(); ++i) {
    const Support& support = project.supports[i];
    regions.push_back({indexed("supports", i) + " \"" + support.name + "\"", support.where, true});
  }
  for (std::size_t i = 0; i < project.loads.size(); ++i)
    if (const Region* where = regionOf(project.loads[i]))
      regions.push_back(
          {indexed("loads", i) + " \"" + project.loads[i].name + "\"", *where, false});
  return regions;
}

Engine engineOf(const Project& project) {
  return engineFor(project.body, project.mesh.engine, meshRegions(project));
}

}  // namespace palpa::modeling
