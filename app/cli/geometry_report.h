#pragma once

#include <vector>

#include "app/cli/command.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::cli {

/// What is wrong with a surface, as a list of objects.
Json toJson(const std::vector<modeling::GeometryFinding>& findings);

}  // namespace palpa::cli
