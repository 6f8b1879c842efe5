#include <algorithm>

#include "base/text.h"
#include "modeling/editing/apply_command.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/knot_operations.h"
#include "modeling/solid/tangent_continuity.h"

namespace palpa::modeling {
namespace {

PatchDirection directionIn(const Solid& solid, const std::string& patch, int direction) {
  if (direction != 0 && direction != 1)
    throw ModelingError("direction: found " + std::to_string(direction) + ", expected 0 or 1");
  return {requirePatch(solid, patch, "patch"), direction};
}

/// Restores the smooth edges that a removal bent. The deviation includes the correction.
KnotRemoval smoothed(const Solid& before, KnotRemoval removal, double tolerance) {
  std::vector<int> bent;
  for (std::size_t e = 0; e < before.edges().size(); ++e) {
    const int edge = static_cast<int>(e);
    if (before.edges()[e].smooth &&
        tangentAngle(removal.solid, edge) > std::max(1e-6, 2.0 * tangentAngle(before, edge)))
      bent.push_back(edge);
  }
  if (bent.empty()) return removal;
  removal.solid = makeTangent(removal.solid, bent);
  removal.deviation = sampledDistance(before, removal.solid);
  if (removal.deviation > tolerance)
    throw ModelingError(
        "tolerance_mm: without the knot and with smooth edges the surface would move "
        "by up to " +
        numberText(removal.deviation) + " mm; " + numberText(tolerance) + " mm are allowed");
  return removal;
}

}  // namespace

Edited applyTo(const InsertKnot& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const PatchDirection at = directionIn(solid, command.patch, command.direction);
  return withBody(project, insertKnot(solid, at, command.at, command.times));
}

Edited applyTo(const RemoveKnot& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const PatchDirection at = directionIn(solid, command.patch, command.direction);
  requirePositive(command.tolerance, "tolerance_mm");
  KnotRemoval removal =
      smoothed(solid, removeKnot(solid, at, command.at, command.times, command.tolerance),
               command.tolerance);
  return withBody(project, std::move(removal.solid), removal.deviation);
}

Edited applyTo(const ElevateDegree& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const PatchDirection at = directionIn(solid, command.patch, command.direction);
  return withBody(project, elevateDegree(solid, at, command.degree));
}

Edited applyTo(const SetEdge& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const int edge = solid.edgeOf(requirePatch(solid, command.patch, "patch"), command.side);
  if (solid.edges()[edge].smooth == command.smooth) return {project, 0.0};
  Solid marked = solid.withSmoothEdges({edge}, command.smooth);
  return withBody(project, command.smooth ? makeTangent(marked, {edge}) : std::move(marked));
}

}  // namespace palpa::modeling
