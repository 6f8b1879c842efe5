#pragma once

#include <Eigen/Core>
#include <string>

#include "app/cli/command.h"

/// Text for users. Internal to app/cli.
namespace palpa::cli {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// "(1.5, 0, -20)": up to `digits` significant digits per number.
std::string toText(const Eigen::Vector3d& vector, int digits = 5);

Json toJson(const Eigen::Vector3d& vector);

}  // namespace palpa::cli
