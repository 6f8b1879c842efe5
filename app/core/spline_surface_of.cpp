#include "app/core/spline_surface_of.h"

#include "modeling/solid/surface_evaluator.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {

bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid) {
  const std::vector<int> groups = modeling::smoothingGroups(
      solid, modeling::sharpEdges(solid, modeling::SurfaceEvaluator(solid)));
  std::vector<bem::SplinePatch> patches;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    const modeling::Patch& from = solid.patches()[p];
    bem::SplinePatch patch{{bem::BsplineBasis(from.degree[0], from.knots[0]),
                            bem::BsplineBasis(from.degree[1], from.knots[1])},
                           {},
                           groups[p]};
    for (int j = 0; j < patch.basis[1].count(); ++j)
      for (int i = 0; i < patch.basis[0].count(); ++i) patch.net.push_back(from.net[i][j]);
    patches.push_back(std::move(patch));
  }
  return {solid.controlPoints(), std::move(patches)};
}

}  // namespace palpa::app
