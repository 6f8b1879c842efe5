#pragma once

#include <nlohmann/json.hpp>

#include "modeling/project/project.h"

// Project files of older versions, brought to kProjectVersion one version at a time. A step from
// version n works on JSON (migrateDocument) and, where it needs geometry, on the project that was
// read from the result (migrateProject). Fixtures of every old version: tests/data/projects/.
namespace palpa::modeling {

/// Upgrades a document in place and returns the version it had, which must be one of
/// 1 … kProjectVersion; all else is left for the schema to judge.
/// @throws ModelingError for keys that its version did not have
int migrateDocument(nlohmann::json& document);

/// Completes what the version a file was written in could not say.
///
/// Version 1 did not know smooth edges: those across which the surface normal turns by at most
/// kSmoothAngle become smooth.
void migrateProject(Project& project, int fileVersion);

inline constexpr double kSmoothAngle = 2.0;  // degrees

}  // namespace palpa::modeling
