#include "modeling/mesh/quarter_crossings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxFound = 100;

/// Two triangles in a plane on both sides of an edge, whose ends are given; `height`: of one of
/// them.
SurfaceMesh pair(const Vector3d& a, const Vector3d& b, double height) {
  const Vector3d along = b - a, up = Vector3d::UnitZ().cross(along).normalized();
  SurfaceMesh mesh;
  mesh.positions = {a, b, a + 0.3 * along + height * up, a + 0.5 * along - up};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

TEST(QuarterCrossings, AreFoundBesideSlivers) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d a(any(generator), any(generator), 0), b(any(generator), any(generator), 0);
    const SurfaceMesh sliver = pair(a, b, 1e-16);
    if (triangleCrossings(sliver.positions, sliver.triangles, kMaxFound).empty())
      found += quarterCrossings(sliver, kMaxFound) > 0 ? 1 : 0;
    EXPECT_EQ(quarterCrossings(pair(a, b, 0.1), kMaxFound), 0) << trial;
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace palpa::modeling
