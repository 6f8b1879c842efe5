#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::cli {

/// Options of a design: targets, points, limits. What is given replaces what the project states.
class DesignOptions {
 public:
  void declare(CLI::App& options);

  /// The design of the project with the options. Throws UsageError for values that cannot be read;
  /// names and ranges are checked by the search.
  modeling::Design design(const modeling::Project& project) const;

 private:
  std::vector<std::string> targets_, move_, stay_, mirrors_;
  std::string points_, along_, largestMovement_, volume_, smallestThickness_, smoothness_,
      tolerance_, steps_;
};

}  // namespace palpa::cli
