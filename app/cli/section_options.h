#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "modeling/mesh/plane_section.h"

namespace palpa::cli {

/// The option --section: a plane that cuts the body.
class SectionOptions {
 public:
  void declare(CLI::App& options, bool isRequired = false);
  bool isGiven() const { return !plane_.empty(); }
  /// None if not given. Throws UsageError.
  std::optional<modeling::Plane> plane() const;

 private:
  std::string plane_;
};

}  // namespace palpa::cli
