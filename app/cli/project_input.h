#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/body_choice.h"
#include "app/cli/body_file.h"
#include "app/cli/command.h"
#include "app/core/model/build_touch_model.h"
#include "modeling/project/project.h"

namespace palpa::cli {

/// The project of a command, with the options that change it for this run.
class ProjectInput {
 public:
  /// Adds FILE, --solid, --unit, --edge-length, --engine, --accuracy and --element-length.
  void declare(CLI::App& options);

  /// Adds --model, for commands that build a model with buildOptions().
  void declareModel(CLI::App& options);
  app::BuildOptions buildOptions() const;

  /// Reads a project, or makes one from a CAD or mesh file, and applies the options. Notes on the
  /// import go to standard error. Throws as readBody(), and UsageError.
  modeling::Project read(const Context& context) const;

  /// The same with the notes, which are not written.
  ReadBody readWithNotes(const Job& job) const;

  /// True if the file is not a project, but a CAD or mesh file.
  bool isImported() const;

  /// True if the command line changes the mesh size.
  bool hasEdgeLength() const { return !edgeLength_.empty(); }

  const std::string& file() const { return file_; }

 private:
  std::string file_, model_;
  BodyChoice choice_;
  std::string edgeLength_, engine_, accuracy_, elementLength_;
};

}  // namespace palpa::cli
