#include "modeling/editing/apply_command.h"
#include "modeling/editing/carry_strokes.h"

namespace palpa::modeling {

namespace {

/// True for commands that move the surface without changing the number of patches and points.
bool movesSurface(const Command& command) {
  return std::holds_alternative<MovePoints>(command) ||
         std::holds_alternative<ScalePoints>(command) ||
         std::holds_alternative<RotatePoints>(command) ||
         std::holds_alternative<AlignPoints>(command) || std::holds_alternative<SetEdge>(command);
}

}  // namespace

Edited withBody(const Project& project, Body body, double deviation) {
  Edited result{project, deviation};
  result.project.body = std::move(body);
  result.project.primitive.reset();
  return result;
}

Edited apply(const Command& command, const Project& project) {
  Edited result = std::visit([&](const auto& one) { return applyTo(one, project); }, command);
  if (movesSurface(command)) carryStrokes(std::get<Solid>(project.body), result.project);
  checkProject(result.project);
  return result;
}

}  // namespace palpa::modeling
