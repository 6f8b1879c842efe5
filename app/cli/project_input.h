#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "modeling/project/project.h"

namespace palpa::cli {

/// The project a command works on, and the options that change it for this run.
class ProjectInput {
 public:
  /// Adds FILE, --edge-length, and what chooses the engine and how fine its elements are.
  void declare(CLI::App& options);

  /// Reads the file and applies the options. Errors as readProject(), and UsageError.
  modeling::Project read() const;

  /// True when the command line changes the mesh size.
  bool hasEdgeLength() const { return !edgeLength_.empty(); }

  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::string edgeLength_, engine_, accuracy_, elementLength_;
};

}  // namespace palpa::cli
