#include "modeling/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_checks.h"
#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

MeshSettings edgeLength(double h) {
  MeshSettings settings;
  settings.edgeLength = h;
  return settings;
}

struct Shape {
  const char* name;
  Solid solid;
  double volume;
  double area;
};

std::vector<Shape> shapes() {
  const double pi = std::numbers::pi;
  return {{"sphere", makeSphere(25.0), 4.0 / 3.0 * pi * 15625.0, 4.0 * pi * 625.0},
          {"cylinder", makeCylinder(20.0, 60.0), pi * 24000.0, pi * 3200.0},
          {"box", makeBox({40.0, 30.0, 20.0}), 24000.0, 5200.0}};
}

TEST(Mesh, IsAClosedOrientedManifoldOnTheSurface) {
  for (const Shape& shape : shapes())
    for (double h : {100.0, 13.0, 5.0, 2.0}) {
      const SurfaceMesh result = mesh(shape.solid, edgeLength(h));
      EXPECT_EQ(checks::manifoldFault(result), "") << shape.name << ' ' << h;
      EXPECT_GT(checks::enclosedVolume(result), 0.0) << shape.name << ' ' << h;
      EXPECT_LT(checks::distanceFromSurface(result, shape.solid), 1e-12);
    }
}

TEST(Mesh, VolumeAndAreaConvergeWithSecondOrder) {
  for (const Shape& shape : shapes()) {
    const SurfaceMesh coarse = mesh(shape.solid, edgeLength(4.0));
    const SurfaceMesh fine = mesh(shape.solid, edgeLength(2.0));
    const double before = std::abs(checks::enclosedVolume(coarse) / shape.volume - 1.0);
    const double after = std::abs(checks::enclosedVolume(fine) / shape.volume - 1.0);
    EXPECT_LT(after, 4e-3) << shape.name;
    EXPECT_LT(std::abs(checks::totalArea(fine) / shape.area - 1.0), 4e-3) << shape.name;
    // Half the triangle size: a quarter of the error; 3.4 allows for rounded counts and the error
    // of the spline itself.
    EXPECT_TRUE(after < before / 3.4 || after < 1e-12)
        << shape.name << ' ' << before << ' ' << after;
  }
}

TEST(Mesh, TrianglesAreWellShapedEvenInTheCornersOfCaps) {
  for (const Shape& shape : shapes())
    for (double h : {8.0, 5.0, 3.0, 2.0, 1.0}) {
      const MeshQuality quality = measureQuality(mesh(shape.solid, edgeLength(h)));
      EXPECT_GT(quality.smallestAngle, 25.0) << shape.name << ' ' << h;
      EXPECT_GT(quality.meanEdge, 0.8 * h) << shape.name;
      EXPECT_LT(quality.meanEdge, 1.5 * h) << shape.name;
    }
}

TEST(Mesh, IsDeterministic) {
  const std::vector<MeshRegion> regions{{"base", Region::below({0.3, 0.1, 1.0}, 11.0), true}};
  MeshSettings settings = edgeLength(4.0);
  settings.refinementLevels = 2;
  settings.refineAtBorders = true;
  const Solid solid = makeCylinder(20.0, 60.0);
  const SurfaceMesh a = mesh(solid, settings, regions);
  const SurfaceMesh b = mesh(solid, settings, regions);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Mesh, EstimateIsCloseAndWorksForAbsurdSizes) {
  for (const Shape& shape : shapes())
    for (double h : {8.0, 4.0, 2.0, 1.0}) {
      const double nodes = static_cast<double>(mesh(shape.solid, edgeLength(h)).positions.size());
      EXPECT_NEAR(estimateNodeCount(shape.solid, edgeLength(h)) / nodes, 1.0, 0.05)
          << shape.name << h;
    }
  EXPECT_GT(estimateNodeCount(makeSphere(25.0), edgeLength(1e-9)), 1e20);
  EXPECT_EQ(estimateNodeCount(makeSphere(25.0), edgeLength(1e-300)),
            std::numeric_limits<double>::infinity());
}

TEST(Mesh, RefusesBeforeItAllocates) {
  try {
    mesh(makeSphere(25.0), edgeLength(1e-4));
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_EQ(error.kind(), ModelingError::Kind::kTooLarge);
  }
  for (double h : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(mesh(makeSphere(25.0), edgeLength(h)), ModelingError);
}

TEST(Mesh, NodesWithCloseNumbersAreClose) {
  const SurfaceMesh result = mesh(makeSphere(25.0), edgeLength(2.0));
  double sum = 0.0;
  for (std::size_t i = 1; i < result.positions.size(); ++i)
    sum += (result.positions[i] - result.positions[i - 1]).norm();
  EXPECT_LT(sum / static_cast<double>(result.positions.size()), 2.0 * 2.0);
}

TEST(Mesh, SelectsPatchesByName) {
  const std::vector<MeshRegion> regions{{"two", Region::ofPatches({"top", "bottom"}), true}};
  const SurfaceMesh result = mesh(makeBox({40, 30, 20}), edgeLength(5.0), regions);
  EXPECT_NEAR(checks::regionArea(result, 0), 2400.0, 1e-9);
}

}  // namespace
}  // namespace palpa::modeling
