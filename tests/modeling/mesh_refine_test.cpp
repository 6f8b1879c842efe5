#include <gtest/gtest.h>

#include <cmath>

#include "mesh_checks.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

MeshSettings refined(double h, int levels, bool edges, bool borders) {
  MeshSettings settings;
  settings.edgeLength = h;
  settings.refinementLevels = levels;
  settings.refineAtSharpEdges = edges;
  settings.refineAtBorders = borders;
  return settings;
}

TEST(Refine, KeepsTheMeshSoundAndTheAnglesGood) {
  const std::vector<MeshRegion> regions{{"base", Region::below({0, 0, 1}, 7.0), true}};
  for (const Solid& solid : {makeBox({40, 30, 20}), makeCylinder(20.0, 60.0), makeSphere(25.0)})
    for (int levels = 1; levels <= 4; ++levels) {
      const SurfaceMesh result = mesh(solid, refined(6.0, levels, true, true), regions);
      EXPECT_EQ(checks::manifoldFault(result), "");
      EXPECT_GT(measureQuality(result).smallestAngle, 20.0) << levels;
      EXPECT_LT(checks::distanceFromSurface(result, solid), 1e-12);
      EXPECT_LT(checks::borderFault(result, 0, {{0, 0, 1}, 7.0}), 1e-9);
    }
}

TEST(Refine, SizeFallsTowardsTheBorder) {
  const Solid sphere = makeSphere(25.0);
  const double d = -20.0;
  const std::vector<MeshRegion> regions{{"base", Region::below({0, 0, 1}, d), true}};
  const SurfaceMesh result = mesh(sphere, refined(5.0, 3, false, true), regions);
  for (const auto& n : result.triangles) {
    double longest = 0.0;
    double away = 1e9;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& x = result.positions[n[k]];
      longest = std::max(longest, (x - result.positions[n[(k + 1) % 3]]).norm());
      // Distance along the sphere from the border.
      away = std::min(away, 25.0 * std::abs(std::asin(x.z() / 25.0) - std::asin(d / 25.0)));
    }
    // A factor 1.6 for the diagonal, a fifth for the subsequent smoothing, a third for distances
    // measured along mesh edges.
    EXPECT_LT(longest, 1.2 * 1.6 * std::min(5.0 * 1.25, 5.0 / 8.0 + 0.5 * away * 1.35) + 1e-9)
        << away;
  }
}

TEST(Refine, BordersOfOtherRegionsStayCoarse) {
  const std::vector<MeshRegion> regions{{"load", Region::below({0, 0, 1}, 7.0), false}};
  const Solid box = makeBox({40, 30, 20});
  EXPECT_EQ(mesh(box, refined(4.0, 3, false, true), regions).positions.size(),
            mesh(box, refined(4.0, 0, false, false), regions).positions.size());
}

TEST(Refine, EstimateHasTheRightMagnitude) {
  const std::vector<MeshRegion> regions{{"base", Region::below({0, 0, 1}, 7.0), true}};
  for (const Solid& solid : {makeBox({40, 30, 20}), makeCylinder(20.0, 60.0), makeSphere(25.0)})
    for (int levels = 1; levels <= 4; ++levels) {
      const MeshSettings settings = refined(6.0, levels, true, true);
      const double nodes = static_cast<double>(mesh(solid, settings, regions).positions.size());
      EXPECT_NEAR(estimateNodeCount(solid, settings, regions) / nodes, 1.0, 0.4) << levels;
    }
}

}  // namespace
}  // namespace palpa::modeling
