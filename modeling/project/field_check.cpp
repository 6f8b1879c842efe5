#include "modeling/project/field_check.h"

#include <cmath>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {

void requireFinite(double value, const std::string& path) {
  if (!std::isfinite(value))
    throw ModelingError(path + ": found " + numberText(value) + ", expected a finite number");
}

void requireFinite(const Eigen::Vector3d& value, const std::string& path) {
  for (int axis = 0; axis < 3; ++axis)
    requireFinite(value[axis], path + "[" + std::to_string(axis) + "]");
}

void requirePositive(double value, const std::string& path) {
  if (!std::isfinite(value) || value <= 0.0)
    throw ModelingError(path + ": found " + numberText(value) +
                        ", expected a finite number greater than 0");
}

void requireDirection(const Eigen::Vector3d& value, const std::string& path) {
  requireFinite(value, path);
  const double length = value.stableNorm();
  if (!(length > 1e-9) || !std::isfinite(length))
    throw ModelingError(path + ": the vector has the length " + numberText(length) +
                        "; expected a direction");
}

int requirePatch(const Solid& solid, std::string_view name, const std::string& path) {
  if (const auto found = solid.findPatch(name)) return *found;
  throw ModelingError(path + ": no patch is named \"" + std::string(name) + "\"; the solid has " +
                      quotedPatchNames(solid));
}

const Solid& requireSolid(const Project& project) {
  const auto* solid = std::get_if<Solid>(&project.body);
  if (!solid)
    throw ModelingError(
        "the body is a mesh without control points and edges; it can be transformed, supported, "
        "loaded and touched, but not remodelled");
  return *solid;
}

}  // namespace palpa::modeling
