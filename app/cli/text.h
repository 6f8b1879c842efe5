#pragma once

#include <Eigen/Core>

#include "app/cli/command.h"
#include "app/report/text.h"

/// Text for users. Internal to app/cli.
namespace palpa::cli {

using report::format;
using report::toText;

Json toJson(const Eigen::Vector3d& vector);

}  // namespace palpa::cli
