#include "modeling/project/project.h"

#include <cmath>
#include <set>

#include "base/text.h"
#include "modeling/error.h"

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
  const auto& [name, youngsModulus, nu] = material;
  requirePositive(youngsModulus, "material.youngs_modulus_MPa");
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
  project.mesh.validate("mesh");
  for (const auto& [patch, factor] : project.mesh.patchFactors)
    if (!surface.names.contains(patch))
      throw ModelingError("mesh.patch_factors." + patch +
                          ": no patch has this name; the body has " +
                          quotedPatchNames(project.body));
  if (project.mesh.engine == Engine::kSplines && !std::holds_alternative<Solid>(project.body))
    throw ModelingError(
        "mesh.engine: a mesh body has no spline patches; select automatic or triangles");
  if (project.primitive && !std::holds_alternative<Solid>(project.body))
    throw ModelingError("primitive: a mesh body is not made from a primitive");
}

const Region* regionOf(const Load& load) {
  if (const auto* pressure = std::get_if<Pressure>(&load.what)) return &pressure->where;
  if (const auto* traction = std::get_if<UniformTraction>(&load.what)) return &traction->where;
  return nullptr;
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

}  // namespace palpa::modeling
