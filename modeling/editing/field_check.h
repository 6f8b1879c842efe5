#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "modeling/project/project.h"

// Checks of the fields of commands; messages begin with the field's path in the command. Commands
// from text were checked against the schema, but those made in code may hold anything.
// All throw ModelingError.
namespace palpa::modeling {

void requireFinite(double value, const std::string& path);
void requireFinite(const Eigen::Vector3d& value, const std::string& path);
void requirePositive(double value, const std::string& path);

/// Finite and long enough to be a direction.
void requireDirection(const Eigen::Vector3d& value, const std::string& path);

/// Index of the patch with this name; the message lists those that exist.
int requirePatch(const Solid& solid, std::string_view name, const std::string& path);

/// The solid of a project. The message says that a mesh body has no control points.
const Solid& requireSolid(const Project& project);

}  // namespace palpa::modeling
