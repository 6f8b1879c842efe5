#pragma once

#include <nlohmann/json.hpp>

#include "modeling/project/project.h"

// Project files of older versions, brought to kProjectVersion one version at a time. A step from
// version n works on JSON (migrateDocument) and, where it needs geometry, on the project that was
// read from the result (migrateProject). Fixtures of every old version: tests/data/projects/.
namespace palpa::modeling {

/// Upgrades a document in place and returns its former version, which must be one of
/// 1 … kProjectVersion; the schema judges everything else.
/// Throws ModelingError if the document has keys that its version did not have.
int migrateDocument(nlohmann::json& document);

/// Replaces the former name of the kind of a touch, in a project, a list of commands or a
/// recording, by the present one: version 2 called balls "probe". Other values stay as they are.
void upgradeKind(nlohmann::json& touch);

/// Adds to a project what the version of its file could not express.
///
/// Version 1 did not know smooth edges: edges across which the surface normal turns by at most
/// kSmoothAngle become smooth.
void migrateProject(Project& project, int fileVersion);

inline constexpr double kSmoothAngle = 2.0;  // degrees

}  // namespace palpa::modeling
