#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::cli {

/// What is wrong with a surface: a list of objects, or a line each.
Json toJson(const std::vector<modeling::GeometryFinding>& findings);
std::string toText(const std::vector<modeling::GeometryFinding>& findings);

}  // namespace palpa::cli
