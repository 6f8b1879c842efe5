#include "modeling/editing/apply_command.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::modeling {

Edited applyTo(const MakePrimitive& command, const Project& project) {
  MadeSolid made = makeMeasuredPrimitive(command.primitive);
  Edited result = withBody(project, std::move(made.solid), made.deviation);
  result.project.primitive = command.primitive;
  return result;
}

}  // namespace palpa::modeling
