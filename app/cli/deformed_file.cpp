#include "app/cli/deformed_file.h"

#include "app/cli/body_file.h"
#include "app/core/results/deformed_solid.h"

namespace palpa::cli {

void DeformedFile::declare(CLI::App& options) {
  options
      .add_option("--deformed", path_,
                  "Write the displaced body as a solid of patches (.json, .step, .iges, .brep) or "
                  "its triangles (.stl, .obj, .ply); needs the spline engine")
      ->type_name("FILE");
}

void DeformedFile::validate() const {
  if (!path_.empty()) requireWritable(path_);
}

void DeformedFile::write(const modeling::Project& project, const app::TouchModel& model,
                         const app::TouchState& state, const Context& context) const {
  if (path_.empty()) return;
  writeBody(app::deformedProject(project, model, state.field), path_, false, modelingJob(context));
  context.progress.clear();
}

}  // namespace palpa::cli
