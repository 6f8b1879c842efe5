#include "modeling/solid/control_normals.h"

#include "modeling/solid/basis.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

std::vector<Eigen::Vector3d> controlNormals(const Solid& solid, const std::vector<int>& points) {
  std::vector<int> placeOf(solid.controlPoints().size(), -1);
  for (std::size_t k = 0; k < points.size(); ++k) placeOf[points[k]] = static_cast<int>(k);
  std::vector<Eigen::Vector3d> sums(points.size(), Eigen::Vector3d::Zero());
  const SurfaceEvaluator surface(solid);
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    const Patch& patch = solid.patches()[p];
    for (std::size_t i = 0; i < patch.net.size(); ++i)
      for (std::size_t j = 0; j < patch.net[i].size(); ++j) {
        const int place = placeOf[patch.net[i][j]];
        if (place < 0) continue;
        sums[place] += surface.normal(
            static_cast<int>(p), greville(patch.knots[0], patch.degree[0], static_cast<int>(i)),
            greville(patch.knots[1], patch.degree[1], static_cast<int>(j)));
      }
  }
  for (Eigen::Vector3d& sum : sums) sum.stableNormalize();
  return sums;
}

}  // namespace palpa::modeling
