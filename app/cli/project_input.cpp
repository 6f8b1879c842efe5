#include "app/cli/project_input.h"

#include "app/cli/values.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {

void ProjectInput::declare(CLI::App& options) {
  options.add_option("file", file_, "Project file (JSON)")->required()->type_name("");
  options
      .add_option("--edge-length", edgeLength_,
                  "Target length of mesh edges in mm, instead of the project's")
      ->type_name("LENGTH");
}

modeling::Project ProjectInput::read() const {
  modeling::Project project = modeling::readProject(file_);
  if (!edgeLength_.empty()) {
    project.mesh.edgeLength = parsePositive("--edge-length", edgeLength_);
  }
  return project;
}

}  // namespace palpa::cli
