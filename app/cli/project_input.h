#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "modeling/project/project.h"

namespace palpa::cli {

/// The project of a command, with the options that change it for this run.
class ProjectInput {
 public:
  /// Adds FILE, --edge-length, --engine, --accuracy and --element-length.
  void declare(CLI::App& options);

  /// Reads the file and applies the options. Throws as readProject(), and UsageError.
  modeling::Project read() const;

  /// True if the command line changes the mesh size.
  bool hasEdgeLength() const { return !edgeLength_.empty(); }

  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::string edgeLength_, engine_, accuracy_, elementLength_;
};

}  // namespace palpa::cli
