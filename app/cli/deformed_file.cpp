#include "app/cli/deformed_file.h"

#include "app/cli/body_file.h"
#include "app/core/results/deformed_solid.h"
#include "modeling/exchange/file_format.h"

namespace palpa::cli {

void DeformedFile::declare(CLI::App& options) {
  options
      .add_option("--deformed", path_,
                  "Write the displaced body of the spline engine as a solid of patches or its "
                  "triangles: " +
                      modeling::endingsText(modeling::isWritable))
      ->type_name("FILE");
}

void DeformedFile::validate() const {
  if (!path_.empty()) modeling::requireFormat(path_, modeling::isWritable);
}

void DeformedFile::write(const modeling::Project& project, const app::TouchModel& model,
                         const app::TouchState& state, const Context& context) const {
  if (path_.empty()) return;
  writeBody(app::deformedProject(project, model, state.field), path_, false, context.job());
  context.progress.clear();
}

}  // namespace palpa::cli
