#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "modeling/project/project.h"

// Checks of the fields of commands. Commands from text have passed the schema, but commands made in
// code may hold any values. All functions throw ModelingError that begins with `path`, the field's
// path in the command.
namespace palpa::modeling {

void requireFinite(double value, const std::string& path);
void requireFinite(const Eigen::Vector3d& value, const std::string& path);
void requirePositive(double value, const std::string& path);

/// Requires a finite vector that is longer than 1e-9.
void requireDirection(const Eigen::Vector3d& value, const std::string& path);

/// Index of the patch with this name; the message lists the existing patches.
int requirePatch(const Solid& solid, std::string_view name, const std::string& path);

/// The solid of a project. Throws ModelingError if the body is a mesh body.
const Solid& requireSolid(const Project& project);

}  // namespace palpa::modeling
