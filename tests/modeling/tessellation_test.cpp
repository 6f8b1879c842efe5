#include "modeling/solid/tessellation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "modeling/shapes/primitives.h"
#include "modeling/solid/surface_evaluator.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

std::vector<Solid> solids() {
  return {makeSphere(25.0), makeCylinder(20.0, 60.0), makeBox({40.0, 30.0, 20.0})};
}

/// Volume enclosed by the triangles, by the divergence theorem.
double enclosed(const Tessellation& tessellation, const Tessellation::Shape& shape) {
  double sum = 0.0;
  for (const auto& [a, b, c] : tessellation.triangles())
    sum += shape.positions[a].dot(shape.positions[b].cross(shape.positions[c]));
  return sum / 6.0;
}

TEST(Tessellation, LiesOnTheSurfaceAndEnclosesTheVolume) {
  for (const Solid& solid : solids()) {
    const Tessellation tessellation(solid, 8);
    const auto shape = tessellation.evaluate(solid.controlPoints());
    const double exact = volume(SurfaceEvaluator(solid));
    EXPECT_NEAR(enclosed(tessellation, shape), exact, 0.01 * exact);
    EXPECT_EQ(shape.positions.size(), static_cast<std::size_t>(tessellation.vertexCount()));
  }
  const Solid sphere = makeSphere(25.0);
  for (const auto& point : Tessellation(sphere).evaluate(sphere.controlPoints()).positions)
    EXPECT_NEAR(point.norm(), 25.0, 0.005);
}

TEST(Tessellation, NormalsPointOutwardsEverywhere) {
  const Solid sphere = makeSphere(25.0);
  const auto onSphere = Tessellation(sphere).evaluate(sphere.controlPoints());
  for (std::size_t i = 0; i < onSphere.positions.size(); ++i)
    EXPECT_GT(onSphere.normals[i].dot(onSphere.positions[i].normalized()), 0.999);
  // The caps of a cylinder are degenerate in their corners.
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const Tessellation tessellation(cylinder);
  const auto shape = tessellation.evaluate(cylinder.controlPoints());
  const int top = *cylinder.findPatch("top");
  for (std::size_t t = 0; t < tessellation.triangles().size(); ++t) {
    if (tessellation.patchOfTriangle()[t] != top) continue;
    for (int vertex : tessellation.triangles()[t]) EXPECT_NEAR(shape.normals[vertex].z(), 1, 1e-9);
  }
}

TEST(Tessellation, FollowsMovedControlPointsLikeTheEvaluator) {
  const Solid sphere = makeSphere(25.0);
  std::vector<Eigen::Vector3d> points = sphere.controlPoints();
  points[10] += Eigen::Vector3d(3, -2, 1);
  const Tessellation tessellation(sphere, 4);
  const auto moved = tessellation.evaluate(points);
  const auto fresh = Tessellation(sphere.withControlPoints(points), 4).evaluate(points);
  for (std::size_t i = 0; i < moved.positions.size(); ++i)
    EXPECT_EQ(moved.positions[i], fresh.positions[i]);
}

TEST(Tessellation, LinesRunAlongBordersAndKnots) {
  const Solid box = makeBox({40.0, 30.0, 20.0});
  const Tessellation tessellation(box, 3);
  EXPECT_EQ(tessellation.borders().size(), 4 * box.patches().size());
  EXPECT_TRUE(tessellation.knotLines().empty());  // one span per patch
  const Solid sphere = makeSphere(25.0);          // four spans: three knot lines per direction
  EXPECT_EQ(Tessellation(sphere).knotLines().size(), 6u * 6u);
}

TEST(Tessellation, RefusesInvalidInput) {
  const Solid box = makeBox({40.0, 30.0, 20.0});
  EXPECT_THROW(Tessellation(box, 0), std::invalid_argument);
  EXPECT_THROW(Tessellation(box).evaluate({}), std::invalid_argument);
}

}  // namespace
}  // namespace palpa::modeling
