#pragma once

#include <string>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"
#include "modeling/project/project.h"

namespace palpa::cli {

/// The option --deformed: writes the displaced body to a separate file.
class DeformedFile {
 public:
  void declare(CLI::App& options);
  /// Throws ModelingError if the name has no known ending. To be called before the work.
  void validate() const;
  /// Does nothing without the option. Throws ModelingError for models of triangles.
  void write(const modeling::Project& project, const app::TouchModel& model,
             const app::TouchState& state, const Context& context) const;

 private:
  std::string path_;
};

}  // namespace palpa::cli
