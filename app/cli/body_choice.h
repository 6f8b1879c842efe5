#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/command.h"
#include "modeling/exchange/cad_import.h"

namespace palpa::cli {

/// Options that choose a body of a CAD or mesh file and place it.
class BodyChoice {
 public:
  /// Adds --solid and --unit.
  void declare(CLI::App& options);
  /// Adds --scale and --up.
  void declarePlacement(CLI::App& options);

  bool isGiven() const {
    return !solid_.empty() || !unit_.empty() || !scale_.empty() || !up_.empty();
  }
  bool hasSolid() const { return !solid_.empty(); }

  /// Sets the options that are given. Throws UsageError.
  void addTo(modeling::ImportOptions& import) const;

 private:
  std::string solid_, unit_, scale_, up_;
};

/// The bodies of a file as placed, and the unit that the file states.
Json toJson(const modeling::FileBodies& found);
std::string toText(const modeling::FileBodies& found, const modeling::ImportPlacement& placement);

}  // namespace palpa::cli
