#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/command.h"
#include "app/core/results/refined_touch.h"

namespace palpa::cli {

/// The options that refine the mesh of a touch until its forces have a wished error.
class RefinementOptions {
 public:
  /// Adds --force-error and --time-limit.
  void declare(CLI::App& options);

  /// Throws UsageError.
  void validate() const;

  bool isGiven() const { return !error_.empty(); }
  /// A single mesh if nothing is given.
  app::ErrorGoal goal() const;

 private:
  std::string error_, seconds_;
};

/// Meshes and errors of a refined touch; docs/guide/command-line.md documents the keys.
Json refinementJson(const app::RefinedTouch& touch, const app::ErrorGoal& goal);
std::string refinementText(const app::RefinedTouch& touch, const app::ErrorGoal& goal);

}  // namespace palpa::cli
