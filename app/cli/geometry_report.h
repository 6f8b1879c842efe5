#pragma once

#include <vector>

#include "app/cli/command.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::cli {

/// Faults of a surface as a list of JSON objects.
Json toJson(const std::vector<modeling::GeometryFinding>& findings);

}  // namespace palpa::cli
