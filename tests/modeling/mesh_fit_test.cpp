#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_checks.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

constexpr double kPi = std::numbers::pi;

SurfaceMesh cut(const Solid& solid, double h, const Eigen::Vector3d& normal, double below) {
  MeshSettings settings;
  settings.edgeLength = h;
  const std::vector<MeshRegion> regions{{"base", Region::below(normal, below), true}};
  return mesh(solid, settings, regions);
}

TEST(Fit, SphereRegionsHaveTheirAreaForAnyMesh) {
  const Solid sphere = makeSphere(25.0);
  for (double h = 1.7; h < 6.5; h += 0.37)
    for (double d : {-21.3, -20.0, -17.0, -12.0, -3.3, 0.0, 8.8, 19.0}) {
      const SurfaceMesh result = cut(sphere, h, Eigen::Vector3d::UnitZ(), d);
      const double exact = 2.0 * kPi * 25.0 * (25.0 + d);
      ASSERT_EQ(checks::manifoldFault(result), "") << h << ' ' << d;
      EXPECT_LT(checks::borderFault(result, 0, {Eigen::Vector3d::UnitZ(), d}), 0.1 * h);
      // Chords of a cap of radius r lose about (h / r)² / 4 of its area, and faces slightly more.
      const double r = std::sqrt(625.0 - d * d);
      EXPECT_NEAR(checks::regionArea(result, 0) / exact, 1.0, 0.35 * h * h / (r * r) + 1e-3)
          << h << ' ' << d;
      // Near z = -17 the border meets the patch edges at a few degrees; the mesh closes the wedge.
      EXPECT_GT(measureQuality(result).smallestAngle, d == -17.0 ? 13.0 : 14.5) << h << ' ' << d;
    }
}

TEST(Fit, RegionAreaConvergesWithSecondOrder) {
  const Solid sphere = makeSphere(25.0);
  const double exact = 2.0 * kPi * 25.0 * 5.0;
  const auto error = [&](double h) {
    return std::abs(checks::regionArea(cut(sphere, h, Eigen::Vector3d::UnitZ(), -20.0), 0) / exact -
                    1.0);
  };
  EXPECT_LT(error(1.0), error(4.0) / 10.0);
  EXPECT_LT(error(1.0), 1.5e-3);
}

TEST(Fit, TheAreaDoesNotJumpWhenTheCutMoves) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  double before = 0.0;
  for (int i = 0; i <= 60; ++i) {
    const double d = 6.0 + 0.1 * i;
    const double area = checks::regionArea(cut(cylinder, 4.0, Eigen::Vector3d::UnitZ(), d), 0);
    // 0.1 mm of height are 12.6 mm²; the mesh may contribute a small additional error.
    if (i > 0) {
      EXPECT_NEAR(area - before, 4.0 * kPi, 6.0) << d;
    }
    before = area;
  }
}

TEST(Fit, HalfSpaceThatTouchesAFaceSelectsNothing) {
  for (const Solid& solid : {makeBox({40, 30, 20}), makeCylinder(20.0, 60.0)})
    EXPECT_THROW(cut(solid, 5.0, Eigen::Vector3d::UnitZ(), 0.0), ModelingError);
  try {
    cut(makeBox({40, 30, 20}), 5.0, Eigen::Vector3d::UnitZ(), -1.0);
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_EQ(std::string(error.what()).find("base: the region contains no part of the surface"),
              0U)
        << error.what();
  }
}

TEST(Fit, HalfSpaceJustAboveAFaceSelectsExactlyThisFace) {
  const Solid box = makeBox({40, 30, 20});
  const SurfaceMesh result = cut(box, 5.0, Eigen::Vector3d::UnitZ(), 1e-3);
  EXPECT_NEAR(checks::regionArea(result, 0), 1200.0, 1e-9);
  for (int t : result.trianglesOfRegion[0])
    EXPECT_EQ(result.patchOfTriangle[t], *box.findPatch("bottom"));
}

TEST(Fit, BoxesCutAtAnyHeightAreExact) {
  const Solid box = makeBox({40, 30, 20});
  for (double h : {6.0, 4.0, 2.3})
    for (double d : {1.0, 2.0, 5.0, 5.001, 9.7, 13.0, 19.0}) {
      const SurfaceMesh result = cut(box, h, Eigen::Vector3d::UnitZ(), d);
      ASSERT_EQ(checks::manifoldFault(result), "");
      EXPECT_NEAR(checks::regionArea(result, 0), 1200.0 + 140.0 * d, 140.0 * 0.05 * h)
          << h << ' ' << d;
      EXPECT_NEAR(checks::totalArea(result), 5200.0, 1e-8);
      EXPECT_GT(measureQuality(result).smallestAngle, 14.5) << h << ' ' << d;
    }
}

TEST(Fit, ObliqueCutsKeepTheBodyAndItsTriangles) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  for (const Solid& solid : {makeBox({40, 30, 20}), makeCylinder(20.0, 60.0)})
    for (double h : {6.0, 4.0, 2.0})
      for (double d : {-10.0, 0.0, 5.0, 13.0}) {
        const SurfaceMesh result = cut(solid, h, normal, d);
        const SurfaceMesh rest = cut(solid, h, -normal, -d);
        ASSERT_EQ(checks::manifoldFault(result), "");
        // The plane and its reverse divide the same body.
        EXPECT_NEAR(checks::regionArea(result, 0) + checks::regionArea(rest, 0),
                    checks::totalArea(result), 0.004 * checks::totalArea(result));
        EXPECT_GT(measureQuality(result).smallestAngle, 10.0) << h << ' ' << d;
      }
}

/// Distance along the edge y = -15, z = 20 of a box between x = at, where a plane crosses it, and
/// the nearest border node on it.
double missedOnEdge(const SurfaceMesh& mesh, double at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int node : checks::borderNodes(mesh, 0)) {
    const Eigen::Vector3d& x = mesh.positions[node];
    if (std::abs(x.y() + 15.0) < 1e-6 && std::abs(x.z() - 20.0) < 1e-6)
      nearest = std::min(nearest, std::abs(x.x() - at));
  }
  return nearest;
}

// Where a plane crosses an edge of the body at a small angle, nodes of the edge are close to it far
// from the crossing. The region must not lose its tip there.
TEST(Fit, TipsBesideAnEdgeAreKept) {
  const Solid box = makeBox({40, 30, 20});
  const double h = 5.0;
  for (double degrees : {1.0, 2.0, 4.0})
    for (double at = -6.0; at < 6.0; at += 0.9) {
      const double angle = degrees * kPi / 180.0;
      const Eigen::Vector3d normal(std::sin(angle), 0, std::cos(angle));
      const SurfaceMesh result = cut(box, h, normal, normal.dot(Eigen::Vector3d(at, -15, 20)));
      ASSERT_EQ(checks::manifoldFault(result), "");
      EXPECT_LT(missedOnEdge(result, at), 0.25 * h) << degrees << ' ' << at;
    }
}

TEST(Fit, ARegionSmallerThanATriangleIsFound) {
  const SurfaceMesh result = cut(makeSphere(25.0), 8.0, Eigen::Vector3d::UnitZ(), -24.9);
  EXPECT_NEAR(checks::regionArea(result, 0), 2.0 * kPi * 25.0 * 0.1, 2.0);
}

TEST(Fit, SeveralRegionsAndUnions) {
  const Solid box = makeBox({40, 30, 20});
  MeshSettings settings;
  settings.edgeLength = 4.0;
  Region both = Region::below(Eigen::Vector3d::UnitX(), -11.0);
  both.parts.push_back(PatchSet{{"side_xmax"}});
  both.parts.push_back(HalfSpace{Eigen::Vector3d::UnitZ(), 7.3});
  const std::vector<MeshRegion> regions{{"low", Region::below(Eigen::Vector3d::UnitZ(), 7.3), true},
                                        {"both", both, false}};
  const SurfaceMesh result = mesh(box, settings, regions);
  EXPECT_EQ(checks::manifoldFault(result), "");
  EXPECT_NEAR(checks::regionArea(result, 0), 1200.0 + 140.0 * 7.3, 1.0);
  // Above z = 7.3 (12.7 mm): the face x = -20 and x = 20, two strips of 9 mm, and 9 × 30 on top.
  EXPECT_NEAR(checks::regionArea(result, 1),
              1200.0 + 140.0 * 7.3 + 12.7 * (30.0 + 30.0 + 18.0) + 270.0, 2.0);
}

}  // namespace
}  // namespace palpa::modeling
