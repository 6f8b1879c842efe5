#include "modeling/editing/apply_command.h"

namespace palpa::modeling {

Edited withBody(const Project& project, Body body, double deviation) {
  Edited result{project, deviation};
  result.project.body = std::move(body);
  result.project.primitive.reset();
  return result;
}

Edited apply(const Command& command, const Project& project) {
  Edited result = std::visit([&](const auto& one) { return applyTo(one, project); }, command);
  checkProject(result.project);
  return result;
}

}  // namespace palpa::modeling
